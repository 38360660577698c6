// SPDX-License-Identifier: MIT
#ifdef KAUSTIK_HAS_EMBREE

#include "framework/run/path_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_number.h"
#include "framework/core/json_schema.h"
#include "framework/core/json_text.h"
#include "framework/run/reference_work.h"
#include "framework/scene/scene_hash.h"

namespace kaustik::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace reference;

constexpr const char* kSchema = "kaustik.paths/1";
constexpr const char* kFolder = "censuses";

// What is worth a word of its own, of all the caustic light.
constexpr double kWorthSaying = 5e-4;
constexpr std::size_t kClassesInASentence = 5;

std::string nameOf(const ArrivedPath& path) {
    return path.interactions > kLongestPathWord ? kOtherClass : textOf(path.word);
}

// Everything that a census depends on but its size in photons; the picture's shape says what is
// seen.
std::string censusKey(const scene::Scene& scene) {
    ContentHash hash;
    hash.addBytes(kSchema);
    scene::addTo(hash, scene);
    return hash.hex();
}

fs::path censusFile(const scene::Scene& scene) {
    return cacheFolder() / kFolder / (censusKey(scene) + ".json");
}

json toJson(const PathCensus& census, int width, int height) {
    json paths = json::array();
    for (const CountedPath& counted : census.paths) {
        const ArrivedPath& path = counted.path;
        // Whole numbers of 64 bits are no numbers in every reader of JSON.
        paths.push_back({{"word", textOf(path.word)},
                         {"interactions", path.interactions},
                         {"object", path.firstObject},
                         {"partly_reflected", path.partlyReflected}});
    }
    json batches = json::array();
    for (const auto& batch : census.byBatch) {
        json values = json::array();
        for (const auto& [all, visible] : batch) {
            values.push_back(all);
            values.push_back(visible);
        }
        batches.push_back(std::move(values));
    }
    return {{"schema", kSchema},
            {"size", {width, height}},
            {"photons", census.photons},
            {"seconds", census.seconds},
            {"watts", census.energy.watts},
            {"visible_w", census.energy.visibleWatts},
            {"paths", std::move(paths)},
            {"batches_w", std::move(batches)}};
}

PathCensus fromJson(const json& from, const scene::Scene& scene) {
    PathCensus census;
    census.photons = wholeNumber<std::uint64_t>(from.at("photons"));
    census.seconds = from.at("seconds");
    census.energy.watts = from.at("watts");
    census.energy.visibleWatts = from.at("visible_w");
    for (const json& one : from.at("paths")) {
        CountedPath counted;
        const std::string word = one.at("word");
        counted.path.interactions = wholeNumber<int>(one.at("interactions"));
        counted.path.firstObject = wholeNumber<std::uint32_t>(one.at("object"));
        counted.path.partlyReflected = one.at("partly_reflected");
        counted.path.word.length = static_cast<int>(word.size());
        if (word.size() > static_cast<std::size_t>(kLongestPathWord) ||
            counted.path.firstObject >= scene.objects.size())
            throw IoError("a census that makes no sense");
        for (std::size_t i = 0; i < word.size(); ++i) {
            if (word[i] == 'R') counted.path.word.reflections |= std::uint64_t{1} << i;
        }
        census.paths.push_back(counted);
    }
    for (const json& values : from.at("batches_w")) {
        if (values.size() != 2 * census.paths.size()) throw IoError("a census that is cut off");
        auto& batch = census.byBatch.emplace_back();
        for (std::size_t i = 0; i < census.paths.size(); ++i)
            batch.emplace_back(values[2 * i].get<double>(), values[2 * i + 1].get<double>());
    }
    for (CountedPath& counted : census.paths) {
        counted.flux = census.fluxOf([&](const ArrivedPath& path) { return path == counted.path; });
    }
    census.all = census.fluxOf([](const ArrivedPath&) { return true; });
    return census;
}

// A part of the caustic light, and all of it.
struct PartTable {
    PathFlux flux;
    double allWatts = 0.0;
};
template <class F>
void reflect(F& f, const PartTable& part) {
    f.field("watts", part.flux.watts, "That arrive at receivers, seen or not");
    f.field("watts_stderr", part.flux.wattsError, "Its standard error");
    f.field("share", part.allWatts > 0.0 ? part.flux.watts / part.allWatts : 0.0,
            "Of all the caustic light that arrives");
}
struct UnformedTable {
    PartTable all;
    std::map<std::string, PartTable> classes;
    std::uint64_t photons = 0;
};
template <class F>
void reflect(F& f, const UnformedTable& table) {
    reflect(f, table.all);
    f.field("classes", table.classes, "The same by class of paths: TT, TRT, R, …, other");
    f.field("census_photons", table.photons, "Of the census that this is of");
}

}  // namespace

bool isModelled(const ArrivedPath& path, const ModelledPaths& paths) {
    return isFollowed(path, modelledFilter({}, paths));
}

std::vector<ClassFlux> classFluxes(const PathCensus& census, std::size_t maximum, double leastShare,
                                   const ModelledPaths* paths) {
    const auto unformedOf = [&](const auto& belongs) {
        if (paths == nullptr) return PathFlux{};
        return census.fluxOf(
            [&](const ArrivedPath& path) { return belongs(path) && !isModelled(path, *paths); });
    };
    std::map<std::string, double> watts;
    std::map<std::string, PathWord> words;
    for (const CountedPath& counted : census.paths) {
        if (counted.path.interactions > kLongestPathWord) continue;
        const std::string name = nameOf(counted.path);
        watts[name] += counted.flux.watts;
        words[name] = counted.path.word;
    }
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, sum] : watts) {
        if (sum >= leastShare * census.all.watts) order.emplace_back(-sum, name);
    }
    std::sort(order.begin(), order.end());
    if (order.size() > maximum) order.resize(maximum);
    std::vector<ClassFlux> classes;
    std::set<std::string> listed;
    for (const auto& [sum, name] : order) {
        listed.insert(name);
        const auto belongs = [&, wanted = name](const ArrivedPath& path) {
            return nameOf(path) == wanted;
        };
        classes.push_back({name, words[name], census.fluxOf(belongs), unformedOf(belongs)});
    }
    const auto isOther = [&](const ArrivedPath& path) { return listed.count(nameOf(path)) == 0; };
    classes.push_back({kOtherClass, {}, census.fluxOf(isOther), unformedOf(isOther)});
    return classes;
}

std::vector<ObjectFlux> objectFluxes(const PathCensus& census, const scene::Scene& scene) {
    std::set<std::string> names;
    for (const CountedPath& counted : census.paths)
        names.insert(scene.objects[counted.path.firstObject].name);
    std::vector<ObjectFlux> objects;
    for (const std::string& name : names) {
        objects.push_back({name, census.fluxOf([&](const ArrivedPath& path) {
                               return scene.objects[path.firstObject].name == name;
                           })});
    }
    std::stable_sort(objects.begin(), objects.end(), [](const ObjectFlux& a, const ObjectFlux& b) {
        return a.flux.watts > b.flux.watts;
    });
    return objects;
}

PathFlux unformedLight(const PathCensus& census, const ModelledPaths& paths) {
    return census.fluxOf([&](const ArrivedPath& path) { return !isModelled(path, paths); });
}

std::vector<std::pair<std::string, double>> lossesOf(const EnergyLedger& ledger,
                                                     const ModelledPaths& paths) {
    using namespace transport;
    const bool followsOne = paths.transmissionOnly || paths.reflectionOnly;
    std::vector<std::pair<std::string, double>> losses;
    for (const auto& [account, name] : lossCauses()) {
        const bool isNotFollowed = (account == kAccountUntracedBranch && followsOne) ||
                                   account == kAccountInternalReflectionLimit ||
                                   account == kAccountBounceLimit ||
                                   account == kAccountNestingLimit;
        if (!isNotFollowed && ledger.watts[account] != 0.0)
            losses.emplace_back(name, ledger.watts[account]);
    }
    return losses;
}

std::string unformedSentence(const PathCensus& census, const ModelledPaths& paths,
                             const std::string& technique) {
    const PathFlux unformed = unformedLight(census, paths);
    if (!(unformed.watts > kWorthSaying * census.all.watts)) return "";
    std::vector<ClassFlux> classes = classFluxes(census, 1000, 0.0, &paths);
    std::stable_sort(classes.begin(), classes.end(), [](const ClassFlux& a, const ClassFlux& b) {
        return a.unformed.watts > b.unformed.watts;
    });
    std::string list;
    std::size_t named = 0;
    for (const ClassFlux& one : classes) {
        if (named == kClassesInASentence || one.unformed.watts < 0.01 * unformed.watts) break;
        list += fmt::format("{}{} {:.3g} W, {:.2g}%", named++ == 0 ? "" : "; ", one.name,
                            one.unformed.watts, 100.0 * one.unformed.watts / census.all.watts);
    }
    return fmt::format(
        "{} cannot form {:.3g} +- {:.1g} W of the caustic light, {:.2g}%: {} (a census of {:.2g} "
        "photons).",
        technique, unformed.watts, unformed.wattsError, 100.0 * unformed.watts / census.all.watts,
        list, static_cast<double>(census.photons));
}

json unformedJson(const PathCensus& census, const ModelledPaths& paths) {
    const double all = census.all.watts;
    UnformedTable table{{unformedLight(census, paths), all}, {}, census.photons};
    for (const ClassFlux& one : classFluxes(census, 16, 1e-5, &paths)) {
        if (one.unformed.watts > 0.0) table.classes[one.name] = {one.unformed, all};
    }
    return jsonOf(table);
}

json unformedSchema() {
    return jsonSchemaOf<UnformedTable>();
}

std::optional<PathCensus> findCensus(const scene::Scene& scene) {
    try {
        std::error_code error;
        if (!fs::is_directory(cacheFolder() / kFolder, error)) return {};
        const fs::path file = censusFile(scene);
        if (!fs::exists(file, error)) return {};
        const json from = parseJson(readFile(file), file.string());
        if (from.at("schema") != kSchema) return {};
        return fromJson(from, scene);
    } catch (const Error&) {
        return {};
    } catch (const json::exception&) {
        return {};
    }
}

PathCensus obtainCensus(const scene::Scene& scene, int width, int height, std::uint64_t photons,
                        int threads, const Watch& watch) {
    if (std::optional<PathCensus> found = findCensus(scene)) {
        // A census has a few less than it was asked for: whole rows of a light's grid.
        if (static_cast<double>(found->photons) >= 0.9 * static_cast<double>(photons))
            return std::move(*found);
    }
    ReferenceRequest request;
    request.width = width;
    request.height = height;
    std::mutex mutex;
    const auto progress = [&](std::uint64_t traced) {
        const std::lock_guard lock(mutex);
        const double share = static_cast<double>(traced) / static_cast<double>(photons);
        watch.tell(std::min(share, 1.0),
                   fmt::format("{:.1f} million photons", 1e-6 * static_cast<double>(traced)));
        return watch.shouldContinue();
    };
    PathCensus census = takeCensus(EmbreeScene(scene), request, {photons, threads, progress});
    if (!watch.shouldContinue())
        throw Error("Interrupted before the census was taken.", kExitFailed);
    const fs::path file = censusFile(scene);
    fs::create_directories(file.parent_path());
    writeFileWhole(file, jsonText(toJson(census, width, height)));
    return census;
}

PathCensus obtainCensus(const scene::Scene& scene, int width, int height, std::uint64_t photons,
                        int threads) {
    catchInterrupts();
    Progress progress("census:");
    return obtainCensus(
        scene, width, height, photons, threads,
        {[] { return !isInterrupted(); },
         [&](double share, const std::string& reached) { progress.updateShare(share, reached); }});
}

}  // namespace kaustik::run

#endif
