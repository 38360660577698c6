// SPDX-License-Identifier: MIT
#include "framework/python/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "framework/core/error.h"
#include "framework/gl/objects.h"
#include "framework/python/session_device.h"
#include "framework/run/explanation.h"
#include "framework/run/listing.h"
#include "techniques/register_all.h"

namespace kaustik::python {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json describe(const params::ParamSet& params, const params::NamedField& named) {
    const params::Field& field = named.field;
    json value = field.json();
    if (const auto* extent = std::get_if<params::Extent*>(&field.target))
        value = {(*extent)->width, (*extent)->height};
    json entry = run::describe(named);
    entry["value"] = std::move(value);
    entry["default"] = named.defaultText;
    entry["is_set"] = params.isSetByUser(named.fullName);
    return entry;
}

// The layers of a texture from its first row to its last.
Array arrayOf(const gl::Texture& texture, std::optional<std::size_t> wanted,
              const std::string& name) {
    const graph::TextureDesc& desc = texture.desc();
    const auto layers = static_cast<std::size_t>(std::max(desc.layers, 1));
    if (wanted && *wanted >= layers) {
        throw ConfigError(fmt::format("There is no layer {}: '{}' has {}, counted from 0.", *wanted,
                                      name, layers));
    }
    const auto channels = static_cast<std::size_t>(gl::formatInfo(desc.format).channels);
    const auto height = static_cast<std::size_t>(desc.height);
    const std::size_t row = static_cast<std::size_t>(desc.width) * channels;
    const std::vector<float> stored = texture.read();
    Array array;
    array.shape = {height, static_cast<std::size_t>(desc.width), channels};
    if (desc.layers > 0 && !wanted) array.shape.insert(array.shape.begin(), layers);
    array.values.reserve(stored.size());
    for (std::size_t layer = wanted.value_or(0); layer < wanted.value_or(layers - 1) + 1; ++layer) {
        for (std::size_t y = height; y-- > 0;) {
            const auto begin =
                stored.begin() + static_cast<std::ptrdiff_t>((layer * height + y) * row);
            array.values.insert(array.values.end(), begin,
                                begin + static_cast<std::ptrdiff_t>(row));
        }
    }
    return array;
}

}  // namespace

const Registry& registry() {
    static const Registry all = registerAll();
    return all;
}

Session::Session(const std::function<scene::Scene()>& loadScene, const SessionOptions& options,
                 const MayWait& mayWait) {
    const auto open = [&](const GoesOn&) {
        static_cast<void>(registry().findTechnique(options.technique));  // before long work
        device_ = std::make_unique<Device>(loadScene(), options);
    };
    try {
        thread_.run(open, mayWait);
    } catch (...) {
        close();
        throw;
    }
}

Session::~Session() {
    close();
}

void Session::close() {
    isClosed_ = true;
    thread_.stopAll();
    try {
        // The context is current there, and nowhere else.
        thread_.run([&](const GoesOn&) { device_.reset(); }, [] { return true; });
    } catch (const DeviceError&) {
        static_cast<void>(device_.release());  // in a process that was forked off: not ours
    }
}

void Session::run(const std::function<void(Device&, const GoesOn&)>& work, const MayWait& mayWait) {
    const auto requireOpen = [&] {
        if (isClosed_)
            throw ConfigError("This renderer is closed; kaustik.open() makes another one.");
    };
    requireOpen();
    thread_.run(
        [&](const GoesOn& goesOn) {
            requireOpen();
            work(*device_, goesOn);
        },
        mayWait);
}

void Session::set(const std::map<std::string, std::string>& settings, const MayWait& mayWait) {
    run(
        [&](Device& device, const GoesOn&) {
            params::ParamSet params = device.settings.params;  // all of them or none
            for (const auto& [name, value] : settings)
                params.set(name, value, "set");
            device.settings.params = std::move(params);
            device.change();
        },
        mayWait);
}

Session::Json Session::param(const std::string& name, const MayWait& mayWait) {
    Json found;
    run(
        [&](Device& device, const GoesOn&) {
            const params::ParamSet& params = device.settings.params;
            const std::string fullName = params.resolve(name, "get");
            for (const params::NamedField& named : params.all()) {
                if (named.fullName == fullName) found = describe(params, named);
            }
        },
        mayWait);
    return found;
}

Session::Json Session::params(const MayWait& mayWait) {
    Json all = Json::array();
    run(
        [&](Device& device, const GoesOn&) {
            for (const params::NamedField& named : device.settings.params.all())
                all.push_back(describe(device.settings.params, named));
        },
        mayWait);
    return all;
}

void Session::disable(const std::vector<std::string>& passes, const MayWait& mayWait) {
    run(
        [&](Device& device, const GoesOn&) {
            RenderSettings wanted = device.settings;
            wanted.disabledPasses = {passes.begin(), passes.end()};
            device.adopt(std::move(wanted));
        },
        mayWait);
}

void Session::resize(const std::string& size, const MayWait& mayWait) {
    run(
        [&](Device& device, const GoesOn&) {
            RenderSettings wanted = device.settings;
            setSize(wanted, size);
            device.adopt(std::move(wanted));
        },
        mayWait);
}

void Session::setSeed(std::uint64_t seed, const MayWait& mayWait) {
    run(
        [&](Device& device, const GoesOn&) {
            device.settings.seed = seed;
            device.change();
        },
        mayWait);
}

void Session::edit(const std::function<scene::SceneEdits()>& read, const MayWait& mayWait) {
    run(
        [&](Device& device, const GoesOn&) {
            applyEdits(device.scene, read());
            device.change();
        },
        mayWait);
}

Session::Json Session::step(const StepRequest& request, const MayWait& mayWait) {
    Json times;
    run([&](Device& device, const GoesOn& goesOn) { times = device.step(request, goesOn); },
        mayWait);
    return times;
}

Array Session::read(const std::string& resource, std::optional<std::size_t> layer,
                    const MayWait& mayWait) {
    Array array;
    run(
        [&](Device& device, const GoesOn& goesOn) {
            const graph::ResourceRef handle = device.requireTexture(resource, goesOn);
            array = arrayOf(device.renderer->texture(handle), layer, resource);
            array.isForDisplay = handle == device.renderer->outputs().picture.display;
        },
        mayWait);
    return array;
}

Session::Json Session::report(const Judgement& judgement, const MayWait& mayWait) {
    Json report;
    run([&](Device& device, const GoesOn& goesOn) { report = device.report(judgement, goesOn); },
        mayWait);
    return report;
}

std::vector<fs::path> Session::save(const fs::path& folder,
                                    const std::vector<std::string>& resources,
                                    const Judgement& judgement, const MayWait& mayWait) {
    std::vector<fs::path> files;
    run([&](Device& device,
            const GoesOn& goesOn) { files = device.save(folder, resources, judgement, goesOn); },
        mayWait);
    return files;
}

Session::Json Session::passes(const MayWait& mayWait) {
    Json passes;
    run(
        [&](Device& device, const GoesOn&) {
            device.prepare();
            passes = run::listPasses(*device.renderer);
        },
        mayWait);
    return passes;
}

Session::Json Session::resources(const MayWait& mayWait) {
    Json resources;
    run(
        [&](Device& device, const GoesOn&) {
            device.prepare();
            resources = run::listResources(*device.renderer);
        },
        mayWait);
    return resources;
}

Session::Json Session::needs(const MayWait& mayWait) {
    Json needs;
    run(
        [&](Device& device, const GoesOn&) {
            device.prepare();
            device.forgetBuild();
            device.renderer->measureDepthComplexity();
            const scene::SceneNeeds& found = device.renderer->needs();
            needs = report::needsJson(found, std::max(found.measuredDepthComplexity, 0));
        },
        mayWait);
    return needs;
}

std::string Session::explain(const MayWait& mayWait) {
    std::string text;
    run(
        [&](Device& device, const GoesOn&) {
            device.prepare();
            device.forgetBuild();
            device.renderer->measureDepthComplexity();
            device.prepare();
            text = run::explain(*device.renderer);
        },
        mayWait);
    return text;
}

Session::Json Session::times(const MayWait& mayWait) {
    Json times;
    run(
        [&](Device& device, const GoesOn&) {
            times = timesOf(device.record);
            times["picture"] =
                device.renderer->graph().nameOf(device.renderer->outputs().picture.display);
            times["is_stale"] = device.isStale;
        },
        mayWait);
    return times;
}

Session::Json Session::state(const MayWait& mayWait) {
    Json state;
    run(
        [&](Device& device, const GoesOn&) {
            const RenderSettings& settings = device.settings;
            state = {{"scene", device.scene.name},
                     {"technique", settings.technique.name},
                     {"size", {settings.width, settings.height}},
                     {"seed", settings.seed},
                     {"time_s", device.scene.timeSeconds},
                     {"device", device.context->info().renderer},
                     {"disabled", device.renderer->settings().disabledPasses}};
        },
        mayWait);
    return state;
}

}  // namespace kaustik::python
