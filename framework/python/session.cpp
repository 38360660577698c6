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
#include "framework/run/settings.h"
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
                 const KeepWaiting& keepWaiting) {
    const auto open = [&](const ShouldContinue&) {
        static_cast<void>(registry().findTechnique(options.technique,
                                                   options.isAsPublished));  // before long work
        device_ = std::make_unique<Device>(loadScene(), options);
    };
    try {
        thread_.run(open, keepWaiting);
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
        thread_.run([&](const ShouldContinue&) { device_.reset(); }, [] { return true; });
    } catch (const DeviceError&) {
        static_cast<void>(device_.release());  // in a process that was forked off: not ours
    }
}

void Session::run(const std::function<void(Device&, const ShouldContinue&)>& work,
                  const KeepWaiting& keepWaiting) {
    const auto requireOpen = [&] {
        if (isClosed_)
            throw ConfigError("This renderer is closed; kaustik.open() makes another one.");
    };
    requireOpen();
    thread_.run(
        [&](const ShouldContinue& shouldContinue) {
            requireOpen();
            work(*device_, shouldContinue);
        },
        keepWaiting);
}

void Session::set(const std::map<std::string, std::string>& settings,
                  const KeepWaiting& keepWaiting) {
    run(
        [&](Device& device, const ShouldContinue&) {
            RenderSettings wanted = device.session->settings();
            assign(wanted.params, assignmentsOf(settings));
            device.change(std::move(wanted));
        },
        keepWaiting);
}

Session::Json Session::param(const std::string& name, const KeepWaiting& keepWaiting) {
    Json found;
    run(
        [&](Device& device, const ShouldContinue&) {
            const params::ParamSet& params = device.session->settings().params;
            const std::string fullName = params.resolve(name, "get");
            for (const params::NamedField& named : params.all()) {
                if (named.fullName == fullName) found = describe(params, named);
            }
        },
        keepWaiting);
    return found;
}

Session::Json Session::params(const KeepWaiting& keepWaiting) {
    Json all = Json::array();
    run(
        [&](Device& device, const ShouldContinue&) {
            for (const params::NamedField& named : device.session->settings().params.all())
                all.push_back(describe(device.session->settings().params, named));
        },
        keepWaiting);
    return all;
}

void Session::disable(const std::vector<std::string>& passes, const KeepWaiting& keepWaiting) {
    run(
        [&](Device& device, const ShouldContinue&) {
            RenderSettings wanted = device.session->settings();
            wanted.disabledPasses = {passes.begin(), passes.end()};
            device.adopt(std::move(wanted));
        },
        keepWaiting);
}

void Session::resize(const std::string& size, const KeepWaiting& keepWaiting) {
    run(
        [&](Device& device, const ShouldContinue&) {
            RenderSettings wanted = device.session->settings();
            run::setSize(wanted, params::parsePictureSize(size, "open"));
            device.adopt(std::move(wanted));
        },
        keepWaiting);
}

void Session::setSeed(std::uint64_t seed, const KeepWaiting& keepWaiting) {
    run(
        [&](Device& device, const ShouldContinue&) {
            RenderSettings wanted = device.session->settings();
            wanted.seed = seed;
            device.change(std::move(wanted));
        },
        keepWaiting);
}

void Session::edit(const std::function<scene::SceneEdits()>& read, const KeepWaiting& keepWaiting) {
    run(
        [&](Device& device, const ShouldContinue&) {
            applyEdits(device.scene, read());
            device.noteEdit();
        },
        keepWaiting);
}

Session::Json Session::step(const StepRequest& request, const KeepWaiting& keepWaiting) {
    Json times;
    run([&](Device& device,
            const ShouldContinue& shouldContinue) { times = device.step(request, shouldContinue); },
        keepWaiting);
    return times;
}

Array Session::read(const std::string& resource, std::optional<std::size_t> layer,
                    const KeepWaiting& keepWaiting) {
    Array array;
    run(
        [&](Device& device, const ShouldContinue& shouldContinue) {
            const graph::ResourceRef handle = device.requireTexture(resource, shouldContinue);
            const Renderer& renderer = device.session->renderer();
            array = arrayOf(renderer.texture(handle), layer, resource);
            array.isForDisplay = handle == renderer.outputs().picture.display;
        },
        keepWaiting);
    return array;
}

Session::Json Session::report(const Judgement& judgement, const KeepWaiting& keepWaiting) {
    Json report;
    run(
        [&](Device& device, const ShouldContinue& shouldContinue) {
            report = device.report(judgement, shouldContinue);
        },
        keepWaiting);
    return report;
}

std::vector<fs::path> Session::save(const fs::path& folder,
                                    const std::vector<std::string>& resources,
                                    const Judgement& judgement, const KeepWaiting& keepWaiting) {
    std::vector<fs::path> files;
    run(
        [&](Device& device, const ShouldContinue& shouldContinue) {
            files = device.save(folder, resources, judgement, shouldContinue);
        },
        keepWaiting);
    return files;
}

Session::Json Session::passes(const KeepWaiting& keepWaiting) {
    Json passes;
    run(
        [&](Device& device, const ShouldContinue&) {
            device.session->prepare();
            passes = run::listPasses(device.session->renderer());
        },
        keepWaiting);
    return passes;
}

Session::Json Session::resources(const KeepWaiting& keepWaiting) {
    Json resources;
    run(
        [&](Device& device, const ShouldContinue&) {
            device.session->prepare();
            resources = run::listResources(device.session->renderer());
        },
        keepWaiting);
    return resources;
}

Session::Json Session::needs(const KeepWaiting& keepWaiting) {
    Json needs;
    run(
        [&](Device& device, const ShouldContinue&) {
            device.session->measureDepthComplexity();
            const scene::SceneNeeds& found = device.session->renderer().needs();
            needs = report::needsJson(found, std::max(found.measuredDepthComplexity, 0));
        },
        keepWaiting);
    return needs;
}

std::string Session::explain(const KeepWaiting& keepWaiting) {
    std::string text;
    run(
        [&](Device& device, const ShouldContinue&) {
            device.session->measureDepthComplexity();
            device.session->prepare();
            text = run::explain(device.session->renderer());
        },
        keepWaiting);
    return text;
}

Session::Json Session::times(const KeepWaiting& keepWaiting) {
    Json times;
    run(
        [&](Device& device, const ShouldContinue&) {
            const Renderer& renderer = device.session->renderer();
            times = timesOf(device.session->record());
            times["picture"] = renderer.graph().nameOf(renderer.outputs().picture.display);
            times["is_stale"] = device.isStale;
        },
        keepWaiting);
    return times;
}

Session::Json Session::state(const KeepWaiting& keepWaiting) {
    Json state;
    run(
        [&](Device& device, const ShouldContinue&) {
            const RenderSettings& settings = device.session->settings();
            state = {{"scene", device.scene.name},
                     {"technique", settings.technique.name},
                     {"as_published", settings.technique.isAsPublished},
                     {"size", {settings.width, settings.height}},
                     {"seed", settings.seed},
                     {"time_s", device.scene.timeSeconds},
                     {"device", device.context->info().renderer},
                     {"disabled", device.session->renderer().settings().disabledPasses}};
        },
        keepWaiting);
    return state;
}

}  // namespace kaustik::python
