// SPDX-License-Identifier: MIT
#include "framework/certify/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/scene/scene_hash.h"

namespace kaustik::certify {
namespace {

namespace fs = std::filesystem;

// Pieces of a block: neighbours of a mesh are in different blocks, so that all take about as long.
constexpr std::uint64_t kBlocks = 256;

float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) <= value
               ? nearest
               : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
float roundedUp(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) >= value
               ? nearest
               : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

void requireRequest(const CertificateRequest& request) {
    const BeamSettings& beams = request.beams;
    if (beams.interactions < 1 || beams.interactions > 8) {
        throw ConfigError(
            fmt::format("--interactions: {} is not from 1 to 8.", beams.interactions));
    }
    if (!(beams.bandPixels >= 1e-6 && beams.bandPixels <= 1.0))
        throw ConfigError(fmt::format("--band: {} is not from 1e-6 to 1.", beams.bandPixels));
    if (beams.maxDepth < 0 || beams.maxDepth > 20)
        throw ConfigError(fmt::format("--depth: {} is not from 0 to 20.", beams.maxDepth));
}

double sumAt(const Image& image, std::size_t pixel) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        sum += static_cast<double>(image.values[pixel * 3 + c]);
    return sum;
}

}  // namespace

double litAbove(const Certificate& certificate) {
    double sum = 0.0;
    std::size_t positive = 0;
    for (std::size_t i = 0; 3 * i < certificate.lower.values.size(); ++i) {
        const double low = sumAt(certificate.lower, i);
        if (!(low > 0.0)) continue;
        sum += low;
        ++positive;
    }
    return positive > 0 ? 1e-3 * sum / static_cast<double>(positive) : 0.0;
}

Tightness tightnessOf(const Certificate& certificate) {
    Tightness result;
    result.pixels = certificate.lower.values.size() / 3;
    const double dark = litAbove(certificate);
    std::vector<double> widths;
    for (std::size_t i = 0; i < result.pixels; ++i) {
        const double low = sumAt(certificate.lower, i);
        const double high = sumAt(certificate.upper, i);
        if (!(high > dark)) continue;
        ++result.lit;
        if (high - low > 0.2 * high) ++result.undecided;
        widths.push_back((high - low) / (0.5 * (high + low)));
    }
    std::sort(widths.begin(), widths.end());
    if (!widths.empty()) {
        result.medianWidth = widths[widths.size() / 2];
        result.p95Width = widths[std::min(widths.size() - 1, widths.size() * 95 / 100)];
    }
    const Interval& deposited = certificate.totals.deposited;
    if (deposited.hi > 0.0) result.totalWidth = deposited.width() / deposited.middle();
    return result;
}

// To be raised whenever an interval may come out otherwise: what is kept of older ones is made
// again.
constexpr int kCertifierVersion = 5;

std::string certificateKey(const scene::Scene& scene, const CertificateRequest& request) {
    ContentHash hash;
    hash.addBytes("kaustik.certificate").add(kCertifierVersion);
    scene::addTo(hash, scene);
    hash.add(request.width).add(request.height).add(request.beams.interactions);
    hash.add(static_cast<int>(request.beams.transmissionOnly));
    hash.add(request.beams.bandPixels).add(request.beams.maxDepth);
    return hash.hex();
}

CertificatePart certifyPart(const scene::Scene& scene, const CertificateRequest& request,
                            const CertifyOptions& options) {
    requireRequest(request);
    const auto begin = std::chrono::steady_clock::now();
    const Geometry geometry(scene);
    const EyeView eye(geometry, request.width, request.height);
    const BeamTracer tracer(geometry, eye, request.beams, options.planted);
    CertificatePart part;
    part.key = certificateKey(scene, request);
    part.scene = scene.name;
    part.request = request;
    part.shard = options.shard;
    part.facets = geometry.facets().size() + 1;
    part.irradianceScale = tracer.irradianceScale();
    part.wattScale = tracer.wattScale();
    part.sums = tracer.emptySums();
    const auto [firstBlock, endBlock] = rangeOf(options.shard, kBlocks);
    part.blocks = endBlock - firstBlock;
    double secondsBefore = 0.0;
    std::error_code error;
    if (!options.keep.empty() && fs::exists(options.keep, error)) {
        try {
            CertificatePart kept = readPart(options.keep);
            if (kept.key == part.key && kept.shard == part.shard && kept.blocks == part.blocks) {
                part = std::move(kept);
                secondsBefore = part.seconds;
            }
        } catch (const IoError&) {
            // It is made again.
        }
    }
    const auto seconds = [&] {
        return secondsBefore +
               std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const auto keep = [&] {
        part.seconds = seconds();
        if (!options.keep.empty()) writePart(options.keep, part);
    };
    const unsigned all = std::max(std::thread::hardware_concurrency(), 1u);
    const unsigned threads = options.threads > 0 ? static_cast<unsigned>(options.threads) : all;
    auto lastKept = std::chrono::steady_clock::now();
    std::atomic<bool> stopped = false;
    std::vector<BoundSums> sums;
    for (unsigned i = 0; i < threads; ++i)
        sums.push_back(tracer.emptySums());
    while (part.blocksDone < part.blocks && !stopped) {
        const std::uint64_t block = firstBlock + part.blocksDone;
        std::atomic<std::uint64_t> next = block;
        std::exception_ptr failure;
        std::mutex mutex;
        const auto work = [&](unsigned thread) {
            try {
                for (;;) {
                    const std::uint64_t piece = next.fetch_add(kBlocks);
                    if (piece >= tracer.pieces() || stopped) return;
                    tracer.trace(piece, sums[thread]);
                    if (!options.progress || thread != 0) continue;
                    const double within =
                        static_cast<double>(piece) / static_cast<double>(tracer.pieces());
                    if (!options.progress((static_cast<double>(part.blocksDone) + within) /
                                              static_cast<double>(part.blocks),
                                          part.sums.cells())) {
                        stopped = true;
                    }
                }
            } catch (...) {
                const std::lock_guard lock(mutex);
                failure = std::current_exception();
                stopped = true;
            }
        };
        std::vector<std::thread> others;
        try {
            for (unsigned i = 1; i < threads; ++i)
                others.emplace_back(work, i);
        } catch (const std::system_error&) {
            // Those that there are do it.
        }
        work(0);
        for (std::thread& other : others)
            other.join();
        if (failure) std::rethrow_exception(failure);
        if (stopped) break;
        for (BoundSums& own : sums) {
            part.sums.merge(own);
            own.clear();
        }
        ++part.blocksDone;
        const auto now = std::chrono::steady_clock::now();
        if (now - lastKept > std::chrono::seconds(30)) {
            keep();
            lastKept = now;
        }
    }
    keep();
    return part;
}

Certificate makeCertificate(const scene::Scene& scene, const std::vector<CertificatePart>& parts) {
    if (parts.empty()) throw ConfigError("certify: there are no parts to merge.");
    const CertificatePart& first = parts.front();
    if (certificateKey(scene, first.request) != first.key) {
        throw ConfigError(fmt::format(
            "certify: the parts are of another scene than '{}', or of it before a change.",
            scene.name));
    }
    const Geometry geometry(scene);
    const EyeView eye(geometry, first.request.width, first.request.height);
    BoundSums sums(static_cast<std::size_t>(first.request.width) *
                       static_cast<std::size_t>(first.request.height),
                   first.facets, first.irradianceScale, first.wattScale);
    Certificate result;
    std::set<std::uint64_t> numbers;
    for (const CertificatePart& part : parts) {
        if (part.key != first.key || part.shard.count != first.shard.count) {
            throw ConfigError("certify: the parts are not of one certificate.");
        }
        if (!part.isWhole()) {
            throw ConfigError(fmt::format("certify: shard {} of {} is not finished.",
                                          part.shard.number, part.shard.count));
        }
        if (!numbers.insert(part.shard.number).second) continue;
        sums.merge(part.sums);
        result.seconds += part.seconds;
    }
    if (numbers.size() != first.shard.count) {
        std::vector<std::uint64_t> missing;
        for (std::uint64_t i = 1; i <= first.shard.count; ++i) {
            if (!numbers.contains(i)) missing.push_back(i);
        }
        throw ConfigError(fmt::format("certify: of {} shards these are missing: {}.",
                                      first.shard.count, listOfNumbers(missing)));
    }
    result.key = first.key;
    result.scene = first.scene;
    result.request = first.request;
    result.totals = sums.totals();
    // No path brings more than the lights send.
    result.totals.deposited.hi = std::min(result.totals.deposited.hi, result.totals.emitted.hi);
    result.cells = sums.cells();
    const int width = first.request.width;
    const int height = first.request.height;
    result.lower = result.upper = result.undecided = Image(width, height, 3);
    const std::array<double, 3> anywhere = sums.undecided(geometry.facets().size());
    for (std::size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
        const Colors found = sums.pixel(pixel);
        std::set<std::uint32_t> seen;
        for (const SeenPart& part : eye.parts(pixel))
            seen.insert(part.facet);
        for (std::size_t c = 0; c < 3; ++c) {
            double watts = seen.empty() ? 0.0 : anywhere[c];
            for (const std::uint32_t facet : seen)
                watts = rounding::up(watts + sums.undecided(facet)[c]);
            const double open =
                rounding::up(rounding::up(watts * eye.maxCoverage(pixel)) + sums.open(pixel)[c]);
            const std::size_t at = pixel * 3 + c;
            result.lower.values[at] = std::max(roundedDown(found[c].lo), 0.0f);
            result.upper.values[at] = roundedUp(rounding::up(found[c].hi + open));
            result.undecided.values[at] = roundedUp(open);
        }
    }
    return result;
}

}  // namespace kaustik::certify
