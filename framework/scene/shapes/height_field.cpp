// SPDX-License-Identifier: MIT
#include "framework/scene/shapes/height_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <future>
#include <glm/gtc/constants.hpp>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/shapes/shape_checks.h"

namespace kaustik::scene {
namespace {

SurfacePoint gridPoint(const HeightField& field, const WavesAtTime& waves, unsigned i, unsigned j) {
    const glm::dvec2 size(field.sizeMeters);
    const glm::dvec2 fromCorner = glm::dvec2(i, j) / glm::dvec2(field.cells) * size;
    const glm::dvec2 xz = fromCorner - 0.5 * size;
    const HeightSample sample = waves.sample(xz);
    return {{xz.x, sample.height, xz.y}, sample.normal, fromCorner};
}

// As many as are worth a thread.
unsigned rowsOfThread(const HeightField& field) {
    constexpr unsigned kSamples = 20'000;
    const auto samplesOfRow =
        static_cast<unsigned>(std::max<std::size_t>(field.waves.size(), 1)) * (field.cells.x + 1);
    return std::max(kSamples / samplesOfRow, 1u);
}

// Calls `work(begin, end)` for all of `count`, on as many threads as there are processors.
template <class Work>
void forRanges(unsigned count, unsigned leastOfThread, const Work& work) {
    const unsigned processors = std::max(std::thread::hardware_concurrency(), 1u);
    const unsigned ranges = std::clamp(count / leastOfThread, 1u, processors);
    const auto border = [&](unsigned i) {
        return static_cast<unsigned>(std::uint64_t{count} * i / ranges);
    };
    std::vector<std::future<void>> others;
    for (unsigned i = 1; i < ranges; ++i) {
        try {
            others.push_back(std::async(std::launch::async, work, border(i), border(i + 1)));
        } catch (const std::system_error&) {  // no more threads are to be had
            work(border(i), border(i + 1));
        }
    }
    work(border(0), border(1));
    for (std::future<void>& other : others)
        other.get();
}

}  // namespace

glm::dvec2 waveVector(const Wave& wave) {
    const double angle = glm::radians(double(wave.directionDegrees));
    const double k = glm::two_pi<double>() / double(wave.wavelengthMeters);
    return k * glm::dvec2(std::cos(angle), std::sin(angle));
}

double angularFrequency(const Wave& wave) {
    if (wave.omegaRadiansPerSecond >= 0.0f) return double(wave.omegaRadiansPerSecond);
    return std::sqrt(kGravityMetersPerSecondSquared * glm::length(waveVector(wave)));
}

WavesAtTime::WavesAtTime(const HeightField& field, double timeSeconds) {
    for (const Wave& wave : field.waves) {
        waves_.push_back({waveVector(wave), angularFrequency(wave) * timeSeconds,
                          double(wave.phaseRadians), double(wave.amplitudeMeters)});
    }
}

HeightSample WavesAtTime::sample(const glm::dvec2& xz) const {
    double height = 0.0;
    glm::dvec2 slope(0.0);
    for (const Moved& wave : waves_) {
        const double phase = glm::dot(wave.vector, xz) - wave.turned + wave.phaseRadians;
        height += wave.amplitudeMeters * std::cos(phase);
        slope -= wave.amplitudeMeters * std::sin(phase) * wave.vector;
    }
    return {height, glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y))};
}

HeightSample evaluateHeightField(const HeightField& field, const glm::dvec2& xz,
                                 double timeSeconds) {
    return WavesAtTime(field, timeSeconds).sample(xz);
}

Mesh makeHeightField(const HeightField& field, double timeSeconds) {
    requirePositive("size", double(field.sizeMeters.x));
    requirePositive("size", double(field.sizeMeters.y));
    requireCells("cells", field.cells.x, 1);
    requireCells("cells", field.cells.y, 1);
    for (const Wave& wave : field.waves) {
        requirePositive("wavelength", double(wave.wavelengthMeters));
    }
    const WavesAtTime waves(field, timeSeconds);
    MeshBuilder builder;
    builder.addGrid(field.cells.x, field.cells.y,
                    [&](unsigned i, unsigned j) { return gridPoint(field, waves, i, j); });
    Mesh mesh = builder.finishSheet("water");
    mesh.heightField = field;
    return mesh;
}

void setTime(Scene& scene, double timeSeconds) {
    scene.timeSeconds = timeSeconds;
    for (Mesh& mesh : scene.meshes) {
        if (!mesh.heightField) continue;
        const HeightField& field = *mesh.heightField;
        const WavesAtTime waves(field, timeSeconds);
        forRanges(field.cells.y + 1, rowsOfThread(field), [&](unsigned begin, unsigned end) {
            std::size_t vertex = std::size_t{begin} * (field.cells.x + 1);
            for (unsigned j = begin; j < end; ++j) {
                for (unsigned i = 0; i <= field.cells.x; ++i, ++vertex) {
                    const SurfacePoint point = gridPoint(field, waves, i, j);
                    mesh.positions[vertex] = glm::vec3(point.position);
                    mesh.normals[vertex] = glm::vec3(point.normal);
                }
            }
        });
    }
}

}  // namespace kaustik::scene
