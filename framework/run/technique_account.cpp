// SPDX-License-Identifier: MIT
#ifdef KAUSTIK_HAS_EMBREE

#include "framework/run/technique_account.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/audit/hit_audit.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/run/session.h"

namespace kaustik::run {
namespace {

using nlohmann::json;
using reference::PathFlux;

constexpr std::size_t kListedClasses = 12;
constexpr double kLeastListedShare = 5e-5;

struct Row {
    std::string technique;
    bool isAsPublished = false;
};

std::string nameOfRow(const std::string& technique, bool isAsPublished) {
    return technique + (isAsPublished ? ", as published" : "");
}

std::vector<Row> rowsOf(const Registry& registry, const CensusRequest& request) {
    std::vector<std::string> names = request.techniques;
    if (names.empty()) {
        for (const Technique& technique : registry.techniques())
            names.push_back(technique.name);
    }
    std::vector<Row> rows;
    for (const std::string& name : names) {
        const Technique& technique = registry.findTechnique(name);
        rows.push_back({name, false});
        if (!technique.asPublished.empty()) rows.push_back({name, true});
    }
    return rows;
}

RenderSettings settingsOf(const Registry& registry, const CensusRequest& request, const Row& row) {
    SettingsRequest wanted{row.technique, request.assignments};
    wanted.isAsPublished = row.isAsPublished;
    wanted.assignments.insert(
        wanted.assignments.begin(),
        params::parseAssignment("emit.photons=" + request.techniquePhotons, "--set"));
    RenderSettings settings = makeSettings(wanted, registry);
    settings.width = request.width;
    settings.height = request.height;
    return settings;
}

TechniqueAccount renderedAccount(gl::Context& context, const Registry& registry,
                                 scene::Scene& scene, RenderSettings settings,
                                 const reference::EmbreeScene& exact, const SceneCensus& census,
                                 const ShouldContinue& shouldContinue) {
    using namespace transport;
    TechniqueAccount account;
    Session session(context, registry, scene, std::move(settings));
    if (!session.renderFor(Purpose::audit, shouldContinue)) return account;
    const Renderer& renderer = session.renderer();
    account.paths = renderer.outputs().hits.incoming.paths;
    setLight(account, census.light);
    // Each photon is followed exactly, too: else what has hit nothing may be lost or have left the
    // scene. And all are judged by the same light.
    const EnergyLedger ledger =
        audit::resolveLedger(renderer, audit::auditHits(renderer, exact), account.emittedWatts);
    account.formedWatts = ledger.watts[kAccountDeposited];
    account.losses = lossesOf(ledger, account.paths);
    for (const auto& [cause, name] : lossCauses()) {
        const bool isLoss =
            std::any_of(account.losses.begin(), account.losses.end(),
                        [&lossName = name](const auto& loss) { return loss.first == lossName; });
        if (!isLoss && ledger.watts[cause] != 0.0)
            account.unfollowed.emplace_back(name, ledger.watts[cause]);
    }
    // As a file of the account has them.
    std::sort(account.losses.begin(), account.losses.end());
    std::sort(account.unfollowed.begin(), account.unfollowed.end());
    return account;
}

std::string csvText(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
    return quoted + "\"";
}

std::string pairsText(const std::vector<std::pair<std::string, double>>& watts, double least) {
    std::vector<std::pair<std::string, double>> sorted = watts;
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
    std::string text;
    for (const auto& [name, value] : sorted) {
        if (std::abs(value) < least) continue;
        text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", name, value);
    }
    return text;
}

json fluxJson(const PathFlux& flux, double all) {
    return {{"watts", flux.watts},
            {"watts_stderr", flux.wattsError},
            {"share", all > 0.0 ? flux.watts / all : 0.0},
            {"visible_w", flux.visibleWatts},
            {"visible_stderr_w", flux.visibleError}};
}

json pairsJson(const std::vector<std::pair<std::string, double>>& watts) {
    json result = json::object();
    for (const auto& [name, value] : watts)
        result[name] = value;
    return result;
}

std::string settingsText(const CensusRequest& request) {
    std::string text = "emit.photons=" + request.techniquePhotons;
    for (const params::Assignment& assignment : request.assignments)
        text += fmt::format(" {}={}", assignment.name, assignment.value);
    return text;
}

// Without what would have to be set instead.
std::string shortProblem(const std::string& problem) {
    return problem.substr(0, problem.find(';'));
}

double shareOf(double part, double all) {
    return all > 0.0 ? 100.0 * part / all : 0.0;
}

}  // namespace

double TechniqueAccount::lostWatts() const {
    double sum = 0.0;
    for (const auto& [cause, watts] : losses)
        sum += watts;
    return sum;
}

std::string TechniqueAccount::rowName() const {
    return nameOfRow(technique, isAsPublished);
}

std::string TechniqueAccount::modelled() const {
    if (paths.interactions == 0) return "no caustic";
    return fmt::format("{}, {} interaction{}",
                       paths.transmissionOnly ? "refracted"
                       : paths.reflectionOnly ? "reflected"
                                              : "both branches",
                       paths.interactions, paths.interactions == 1 ? "" : "s");
}

void setLight(TechniqueAccount& account, const reference::PathCensus& light) {
    account.emittedWatts = light.energy.watts[transport::kAccountEmitted];
    account.unformed = unformedLight(light, account.paths);
    account.classes = classFluxes(light, kListedClasses, kLeastListedShare, &account.paths);
}

SceneCensus censusOfPaths(const scene::Scene& scene, const CensusRequest& request,
                          const Watch& watch) {
    SceneCensus census;
    census.scene = scene.name;
    census.request = request;
    census.light =
        obtainCensus(scene, request.width, request.height, request.photons, request.threads, watch);
    census.classes = classFluxes(census.light, kListedClasses, kLeastListedShare);
    census.objects = objectFluxes(census.light, scene);
    return census;
}

SceneCensus accountFor(gl::Context& context, const Registry& registry, scene::Scene& scene,
                       const CensusRequest& request, const Watch& watch) {
    const std::vector<Row> all = rowsOf(registry, request);
    std::vector<Row> rows;
    const Shard shard = request.shard.value_or(Shard{});
    for (std::size_t i = shard.number - 1; i < all.size(); i += shard.count)
        rows.push_back(all[i]);
    std::vector<RenderSettings> settings;
    for (const Row& row : rows)
        settings.push_back(settingsOf(registry, request, row));
    SceneCensus census = censusOfPaths(scene, request, watch);
    census.device = context.info().renderer;
    census.settings = settingsText(request);
    for (const Row& row : all)
        census.rows.push_back(nameOfRow(row.technique, row.isAsPublished));
    const auto requireContinued = [&] {
        if (!watch.shouldContinue())
            throw Error("Interrupted; the census of paths is kept.", kExitFailed);
    };
    const reference::EmbreeScene exact(scene);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        requireContinued();
        watch.tell(static_cast<double>(i) / static_cast<double>(rows.size()),
                   nameOfRow(rows[i].technique, rows[i].isAsPublished));
        TechniqueAccount account;
        try {
            account = renderedAccount(context, registry, scene, std::move(settings[i]), exact,
                                      census, [&](std::size_t) { return watch.shouldContinue(); });
        } catch (const ConfigError& error) {
            account.problem = error.what();  // it does not go with this scene
        }
        requireContinued();
        account.technique = rows[i].technique;
        account.isAsPublished = rows[i].isAsPublished;
        census.techniques.push_back(std::move(account));
    }
    return census;
}

json toJson(const SceneCensus& census) {
    const double all = census.light.all.watts;
    json result = {{"schema", "kaustik.census/1"},
                   {"version", versionString()},
                   {"scene", census.scene},
                   {"device", census.device},
                   {"settings", census.settings},
                   {"photons", census.light.photons},
                   {"energy", reference::toJson(census.light.energy)},
                   {"arriving", fluxJson(census.light.all, all)}};
    if (const CensusRequest& request = census.request; request.shard) {
        result["shard"] = {
            {"part", fmt::format("{}/{}", request.shard->number, request.shard->count)},
            {"size", {request.width, request.height}},
            {"photons", request.photons},
            {"rows", census.rows}};
    }
    for (const ClassFlux& one : census.classes) {
        json row = fluxJson(one.flux, all);
        row["class"] = one.name;
        result["classes"].push_back(std::move(row));
    }
    result["objects"] = json::array();
    for (const ObjectFlux& one : census.objects) {
        json row = fluxJson(one.flux, all);
        row["first_object"] = one.name;
        result["objects"].push_back(std::move(row));
    }
    result["techniques"] = json::array();
    for (const TechniqueAccount& account : census.techniques) {
        json row = {{"technique", account.technique}, {"as_published", account.isAsPublished}};
        if (!account.problem.empty()) {
            row["problem"] = account.problem;
            result["techniques"].push_back(std::move(row));
            continue;
        }
        row["models"] = {{"transmission_only", account.paths.transmissionOnly},
                         {"reflection_only", account.paths.reflectionOnly},
                         {"maximum_interactions", account.paths.interactions}};
        row["forms_w"] = account.formedWatts;
        row["cannot_form"] = fluxJson(account.unformed, all);
        row["cannot_form"]["classes"] = json::object();
        for (const ClassFlux& one : account.classes) {
            if (one.unformed.watts > 0.0)
                row["cannot_form"]["classes"][one.name] = fluxJson(one.unformed, all);
        }
        row["loses_w"] = pairsJson(account.losses);
        row["not_followed_w"] = pairsJson(account.unfollowed);
        result["techniques"].push_back(std::move(row));
    }
    return result;
}

std::string classesCsv(const SceneCensus& census) {
    std::string text = "scene,kind,name,watts,watts stderr,share,visible,visible stderr,version\n";
    const auto add = [&](const char* kind, const std::string& name, const PathFlux& flux) {
        text += fmt::format("{},{},{},{:.5g},{:.2g},{:.5g},{:.5g},{:.2g},{}\n",
                            csvText(census.scene), kind, csvText(name), flux.watts, flux.wattsError,
                            shareOf(flux.watts, census.light.all.watts) / 100.0, flux.visibleWatts,
                            flux.visibleError, versionString());
    };
    add("all", "all", census.light.all);
    for (const ClassFlux& one : census.classes)
        add("class", one.name, one.flux);
    for (const ObjectFlux& one : census.objects)
        add("first object", one.name, one.flux);
    return text;
}

std::string techniquesCsv(const SceneCensus& census) {
    std::string text =
        "scene,technique,as_published,status,message,models,emitted,arrives,forms,forms share,"
        "cannot form,cannot form stderr,cannot form share,cannot form by class,loses,loses share,"
        "loses by cause,device,version\n";
    const double all = census.light.all.watts;
    for (const TechniqueAccount& account : census.techniques) {
        text += fmt::format("{},{},{},", csvText(census.scene), account.technique,
                            account.isAsPublished ? "true" : "false");
        if (!account.problem.empty()) {
            text += fmt::format("does not go,{},,,,,,,,,,,,,{},{}\n",
                                csvText(shortProblem(account.problem)), csvText(census.device),
                                versionString());
            continue;
        }
        std::vector<std::pair<std::string, double>> classes;
        for (const ClassFlux& one : account.classes)
            classes.emplace_back(one.name, one.unformed.watts);
        const double lost = account.lostWatts();
        text += fmt::format(
            "done,,{},{:.5g},{:.5g},{:.5g},{:.4g},{:.5g},{:.2g},{:.4g},{},{:.5g},"
            "{:.4g},{},{},{}\n",
            csvText(account.modelled()), account.emittedWatts, all, account.formedWatts,
            shareOf(account.formedWatts, all) / 100.0, account.unformed.watts,
            account.unformed.wattsError, shareOf(account.unformed.watts, all) / 100.0,
            csvText(pairsText(classes, 1e-3 * all)), lost, shareOf(lost, all) / 100.0,
            csvText(pairsText(account.losses, 3e-3 * all)), csvText(census.device),
            versionString());
    }
    return text;
}

std::string makeTable(const SceneCensus& census) {
    const PathFlux& all = census.light.all;
    std::string text = fmt::format(
        "{}: of {:.4g} W that hit a specular surface, {:.4g} +- {:.1g} W arrive at receivers, "
        "{:.4g} W of it in the picture; {:.3g} photons\n",
        census.scene, census.light.energy.watts[transport::kAccountEmitted], all.watts,
        all.wattsError, all.visibleWatts, static_cast<double>(census.light.photons));
    const auto row = [&](const std::string& name, const PathFlux& flux) {
        text += fmt::format("  {:<24}{:>12.4g}{:>10.1g}{:>11.3f} %{:>12.4g}\n", name, flux.watts,
                            flux.wattsError, shareOf(flux.watts, all.watts), flux.visibleWatts);
    };
    text += fmt::format("{:<26}{:>12}{:>10}{:>13}{:>12}\n", "class", "W", "+-", "share", "seen, W");
    for (const ClassFlux& one : census.classes)
        row(one.name, one.flux);
    text += "by the first specular object\n";
    for (const ObjectFlux& one : census.objects)
        row(one.name, one.flux);
    text += fmt::format("{:<42}{:<32}{:>10}{:>16}{:>9}{:>10}  {}\n", "technique", "models",
                        "forms, W", "cannot form, W", "", "loses, W", "by cause");
    for (const TechniqueAccount& account : census.techniques) {
        const std::string name = account.rowName();
        if (!account.problem.empty()) {
            text += fmt::format("  {:<40}does not go with this scene: {}\n", name,
                                shortProblem(account.problem));
            continue;
        }
        std::vector<std::pair<std::string, double>> classes;
        for (const ClassFlux& one : account.classes)
            classes.emplace_back(one.name, one.unformed.watts);
        text += fmt::format("  {:<40}{:<32}{:>10.4g}{:>16.4g}{:>7.2f} %{:>10.3g}  {}\n", name,
                            account.modelled(), account.formedWatts, account.unformed.watts,
                            shareOf(account.unformed.watts, all.watts), account.lostWatts(),
                            pairsText(account.losses, 1e-3 * all.watts));
        const std::string unformed = pairsText(classes, 1e-3 * all.watts);
        if (!unformed.empty()) text += fmt::format("      cannot form: {}\n", unformed);
    }
    return text;
}

}  // namespace kaustik::run

#endif
