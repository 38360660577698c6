// SPDX-License-Identifier: MIT
#include "framework/reference/path_census.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "framework/core/error.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/threads.h"

namespace kaustik::reference {
namespace {

// Photons of a census by which classes are chosen, and what its seed differs by from that of the
// reference, whose noise must not choose them.
constexpr std::uint64_t kPhotonsToChoose = 1u << 18;
constexpr std::uint64_t kSeedToChoose = 0x5ca1ab1e;

struct PathHash {
    std::size_t operator()(const ArrivedPath& path) const {
        std::uint64_t z = path.word.reflections * 0x9e3779b97f4a7c15u;
        z = (z ^ static_cast<std::uint64_t>(path.interactions)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ path.firstObject ^ (z >> 31)) * 0x94d049bb133111ebu;
        return static_cast<std::size_t>(z ^ (z >> 29));
    }
};

// Of one batch, W.
using Found = std::unordered_map<ArrivedPath, std::pair<double, double>, PathHash>;

struct Counter {
    const EmbreeScene& scene;
    const Eye& eye;
    Found& found;
    Energy& energy;

    void emitted(const glm::dvec3& flux) { energy.add(transport::kAccountEmitted, flux); }
    void absorbed(const glm::dvec3& flux) { energy.add(transport::kAccountAbsorbed, flux); }
    void lost(unsigned account, const glm::dvec3& flux) { energy.add(account, flux); }
    void passed(const PhotonState&, double, const glm::dvec3&, Random&) {}
    void leftScene(const PhotonState& photon) {
        energy.add(transport::kAccountLeftScene, photon.fluxWatts);
    }
    void hitSurface(const SurfaceHit&, const PhotonState&) {}
    void arrived(const SurfaceHit& hit, const PhotonState& photon) {
        const double watts = transport::wattsOf(photon.fluxWatts);
        if (!std::isfinite(watts + hit.distance)) return;
        energy.add(transport::kAccountDeposited, photon.fluxWatts);
        auto& [all, visible] = found[arrivedPathOf(photon)];
        all += watts;
        const Projection at = eye.project(hit.position);
        if (!at.onScreen || !eye.seesSide(hit.position, hit.geometricNormal, photon.direction) ||
            !eye.isVisible(scene, hit.position, hit.triangle, at.depth))
            return;
        visible += watts;
        energy.visibleWatts += watts;
    }
};

// Mean and standard error of the batches' sums.
class Statistics {
  public:
    void add(double value) {
        ++count_;
        const double step = value - mean_;
        mean_ += step / count_;
        spread_ += step * (value - mean_);
    }
    [[nodiscard]] double mean() const { return mean_; }
    [[nodiscard]] double error() const {
        return count_ < 2.0 ? 0.0 : std::sqrt(spread_ / (count_ * (count_ - 1.0)));
    }

  private:
    double count_ = 0.0;
    double mean_ = 0.0;
    double spread_ = 0.0;
};

struct Statistic {
    Statistics all;
    Statistics visible;
    [[nodiscard]] PathFlux flux() const {
        return {all.mean(), all.error(), visible.mean(), visible.error()};
    }
};

// Orders paths that bring the same by what they are, so that equal ones do not change places.
bool isBefore(const ArrivedPath& a, const ArrivedPath& b) {
    return std::tuple(a.interactions, a.word.reflections, a.firstObject, a.partlyReflected) <
           std::tuple(b.interactions, b.word.reflections, b.firstObject, b.partlyReflected);
}

PathCensus summed(const std::vector<Found>& batches) {
    PathCensus census;
    std::unordered_map<ArrivedPath, std::size_t, PathHash> places;
    std::vector<ArrivedPath> paths;
    for (const Found& batch : batches) {
        for (const auto& [path, watts] : batch)
            paths.push_back(path);
    }
    std::sort(paths.begin(), paths.end(), isBefore);
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        Statistic one;
        for (const Found& batch : batches) {
            const auto at = batch.find(paths[i]);
            const auto [all, visible] = at == batch.end() ? std::pair(0.0, 0.0) : at->second;
            one.all.add(all);
            one.visible.add(visible);
        }
        census.paths.push_back({paths[i], one.flux()});
    }
    std::stable_sort(
        census.paths.begin(), census.paths.end(),
        [](const CountedPath& a, const CountedPath& b) { return a.flux.watts > b.flux.watts; });
    for (const Found& batch : batches) {
        auto& values = census.byBatch.emplace_back();
        for (const CountedPath& counted : census.paths) {
            const auto at = batch.find(counted.path);
            values.push_back(at == batch.end() ? std::pair(0.0, 0.0) : at->second);
        }
    }
    census.all = census.fluxOf([](const ArrivedPath&) { return true; });
    return census;
}

}  // namespace

PathFlux PathCensus::fluxOf(const std::function<bool(const ArrivedPath&)>& belongs) const {
    std::vector<bool> counts(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i)
        counts[i] = belongs(paths[i].path);
    Statistic statistic;
    for (const auto& batch : byBatch) {
        double sum = 0.0;
        double visible = 0.0;
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (!counts[i]) continue;
            sum += batch[i].first;
            visible += batch[i].second;
        }
        statistic.all.add(sum);
        statistic.visible.add(visible);
    }
    return statistic.flux();
}

bool isFollowed(const ArrivedPath& path, const PathFilter& filter) {
    if (path.interactions > filter.maximumInteractions) return false;
    if (filter.transmissionOnly && path.partlyReflected) return false;
    const std::uint64_t all = path.word.length >= kLongestPathWord
                                  ? ~std::uint64_t{0}
                                  : (std::uint64_t{1} << path.word.length) - 1;
    return !filter.reflectionOnly || path.word.reflections == all;
}

PathCensus takeCensus(const EmbreeScene& scene, const ReferenceRequest& request,
                      const CensusOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const LightSampler sampler(scene, std::max<std::uint64_t>(1, options.photons / kCensusBatches));
    const Eye eye(scene, request.width, request.height);
    const LightTransport transport(scene, request.filter);
    std::vector<Found> found(kCensusBatches);
    std::vector<Energy> energies(kCensusBatches);
    std::atomic<std::uint64_t> traced{0};
    std::atomic<bool> isStopped{false};
    runWithThreads(options.threads, [&] {
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t batch) {
            Counter counter{scene, eye, found[batch], energies[batch]};
            for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
                if (i % kPhotonsPerPulse == 0) {
                    traced += i == 0 ? 0 : kPhotonsPerPulse;
                    if (options.progress && !options.progress(traced)) isStopped = true;
                    if (isStopped) return;
                }
                Random random(request.seed, batch, i);
                const EmittedPhoton emitted = sampler.sample(i, random);
                transport.follow(stateOf(emitted), emitted.reach, random, counter);
            }
        });
    });
    if (isStopped) return {};
    PathCensus census = summed(found);
    for (const Energy& energy : energies) {
        for (std::size_t account = 0; account < energy.watts.size(); ++account)
            census.energy.watts[account] += energy.watts[account] / kCensusBatches;
        census.energy.visibleWatts += energy.visibleWatts / kCensusBatches;
    }
    census.photons = sampler.photonsPerBatch() * kCensusBatches;
    census.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return census;
}

std::vector<PathClass> chooseClasses(const EmbreeScene& scene, const ReferenceRequest& request,
                                     const ClassOrder& order, const std::string& patternsPlace,
                                     const std::string& countPlace) {
    if (request.estimator != Estimator::light) {
        throw ConfigError(fmt::format("{}: only the estimator light tells paths apart.",
                                      order.patterns.empty() ? countPlace : patternsPlace));
    }
    if (order.count < 0 || order.count > kMaximumClasses) {
        throw ConfigError(
            fmt::format("{}: {} is not from 0 to {}.", countPlace, order.count, kMaximumClasses));
    }
    std::vector<PathClass> classes;
    for (const std::string& text : order.patterns)
        classes.push_back(pathClassOf(text, patternsPlace));
    requireClasses(classes, scene.scene(), patternsPlace);
    if (order.count == 0) return classes;

    ReferenceRequest pilot = request;
    pilot.seed += kSeedToChoose;
    const PathCensus census = takeCensus(scene, pilot, {kPhotonsToChoose, 0, {}});
    PathClassifier named(scene.scene(), classes);
    struct Candidate {
        PathClass one;
        double visible = 0.0;
        double watts = 0.0;
    };
    std::vector<Candidate> candidates;
    for (const CountedPath& counted : census.paths) {
        if (counted.path.interactions > kLongestPathWord ||
            named.classOf(counted.path) < classes.size())
            continue;
        std::string pattern = textOf(counted.path.word);
        if (order.byObject) {
            const std::string& object = scene.scene().objects[counted.path.firstObject].name;
            if (!object.empty()) pattern += "@" + object;
        }
        auto at = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& known) {
            return known.one.pattern == pattern;
        });
        if (at == candidates.end()) {
            candidates.push_back({{layerName(pattern), pattern}});
            at = candidates.end() - 1;
        }
        at->visible += counted.flux.visibleWatts;
        at->watts += counted.flux.watts;
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) {
                         return std::pair(a.visible, a.watts) > std::pair(b.visible, b.watts);
                     });
    const std::size_t wanted = classes.size() + static_cast<std::size_t>(order.count);
    for (const Candidate& candidate : candidates) {
        if (classes.size() < wanted) classes.push_back(candidate.one);
    }
    requireClasses(classes, scene.scene(), countPlace);
    return classes;
}

std::uint64_t bytesOfSums(const EmbreeScene& scene, const ReferenceRequest& request, int threads) {
    const auto layers =
        static_cast<std::uint64_t>(firstClassLayer(scene.scene())) +
        (request.classes.empty() ? 0 : static_cast<std::uint64_t>(request.classes.size()) + 1);
    const std::uint64_t values = static_cast<std::uint64_t>(request.width) *
                                 static_cast<std::uint64_t>(request.height) * 3 * layers;
    const auto batches = static_cast<std::uint64_t>(threadCount(threads)) + 1;
    // Sums and sums of squares, and a copy of them while they are saved; the batches at hand.
    return values * (4 * sizeof(Int128) + batches * sizeof(double));
}

}  // namespace kaustik::reference
