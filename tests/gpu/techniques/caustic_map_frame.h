// SPDX-License-Identifier: MIT
// Frames of caustic maps, read back: what became of each photon, and what each texel of a light's
// map holds. World space, m, W.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/pipeline/ledger.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/pipeline/registry.h"
#include "framework/render/raster_views.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {

// A photon between its last interaction and the receiver.
struct MapPhoton {
    std::uint32_t cell = 0;
    bool isReflected = false;
    glm::dvec3 entry{0.0};  // where light of its light has first hit
    glm::dvec3 entryFlux{0.0};
    glm::dvec3 position{0.0};  // where it left
    glm::dvec3 direction{0.0};
    glm::dvec3 flux{0.0};
    std::uint32_t fate = 0;
    glm::dmat2 place{0.0};  // its beam, where it has one
    glm::dmat2 turn{0.0};
    std::uint32_t hitFate = 0;
    glm::dvec3 hit{0.0};
    glm::dvec3 hitFlux{0.0};
    // Side of a square of the beam's area after so many metres.
    [[nodiscard]] double widthAfter(double distance) const;
};

// One set of one view of a map, lower left texel first.
struct MapTexels {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> flux;  // W; of direct reads of the sums exact to the unit
    [[nodiscard]] const glm::dvec3& at(int x, int y) const {
        return flux[static_cast<std::size_t>(y * width + x)];
    }
    [[nodiscard]] glm::dvec3 sum() const;
};

// Of any frame that has maps: a set of a view of the map of a light.
[[nodiscard]] MapTexels storedIn(const numerics::Frame& frame, int set = 0, int view = 0,
                                 std::size_t light = 0);
[[nodiscard]] const render::RasterView& mapViewOf(const numerics::Frame& frame, int view = 0,
                                                  std::size_t light = 0);
// Where a view sees a place, in texels from its lower left corner, and the other way round: the
// place that is `depth` m before it.
[[nodiscard]] glm::dvec2 texelOn(const render::RasterView& view, const glm::dvec3& world);
[[nodiscard]] glm::dvec3 placeBefore(const render::RasterView& view, const glm::dvec2& texel,
                                     double depth);

class MapFrame : public numerics::Frame {
  public:
    // `hasBeams`: photons carry beams, whoever uses them.
    MapFrame(const scene::Scene& scene, const std::string& technique, const Settings& settings,
             bool hasBeams = false, int width = 100, int height = 75);

    // Of the first tracing, which light comes to after the first specular stage.
    [[nodiscard]] std::vector<MapPhoton> photons() const;
    // What a filter has made of it.
    [[nodiscard]] MapTexels filtered(int view = 0, std::size_t light = 0) const;
    // Photons that were counted in a set.
    [[nodiscard]] std::vector<std::uint32_t> counts(int set = 0, std::size_t light = 0) const;
    // All words of all maps: equal ones are equal to the bit.
    [[nodiscard]] std::vector<std::uint32_t> words() const;
    [[nodiscard]] const FluxMap& map(std::size_t light = 0) const;
    [[nodiscard]] double watts(std::uint32_t account) const;
    // That the ledger balances, and everything that arrived is in an account.
    void expectBalance() const;

  private:
    bool hasBeams_;
};

// Watts of one channel that a unit of the map's sums stands for.
[[nodiscard]] double mapUnit(const scene::Scene& scene);

// Fresnel's transmittance for unpolarised light that comes in at this cosine.
[[nodiscard]] double transmittance(double cosine, double from, double to);
// Snell's law; zero where all is reflected. `normal`: towards where the light comes from.
[[nodiscard]] glm::dvec3 refractedBy(const glm::dvec3& direction, const glm::dvec3& normal,
                                     double from, double to);

}  // namespace kaustik::test
