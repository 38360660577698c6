// SPDX-License-Identifier: MIT
// The environment of a scene as a light: its latitude-longitude picture in cells, which are drawn
// by their flux, and parts of equal flux, for each of which one direction may stand.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

class EmittingEnvironment {
  public:
    // Decodes the picture (IoError where that is not to be read), of which cells of 0.7 degrees
    // keep the mean; without one the sky is even.
    explicit EmittingEnvironment(const Scene& scene);

    // Flux on a surface that faced all of it at once, W/m²: the integral of the radiance.
    [[nodiscard]] const glm::dvec3& fluxPerSquareMeter() const { return flux_; }

    struct Part {
        glm::dvec3 direction{0.0};           // unit, towards that part of the sky, world space
        glm::dvec3 fluxPerSquareMeter{0.0};  // as above, of the part
        // Of an even disc whose light is as far from its middle in the mean square, rad.
        double radius = 0.0;
    };
    // The median cut (Debevec 2005): halves of equal flux along the longer side.
    [[nodiscard]] std::vector<Part> parts(int count) const;
    // A direction drawn by flux, of a number that says which cell and two that say where in it, all
    // in [0, 1): a part that stands for all of the light.
    [[nodiscard]] Part draw(double which, double u, double v) const;

  private:
    struct Area {
        int left, right, bottom, top;  // cells, one past the last
    };
    [[nodiscard]] std::size_t at(int column, int row) const;
    [[nodiscard]] glm::dvec3 directionOf(double column, double row) const;
    [[nodiscard]] double weightOf(const Area& area) const;
    void addParts(const Area& area, int count, std::vector<Part>& all) const;

    double turnRadians_ = 0.0;
    int columns_ = 0;
    int rows_ = 0;                    // from the bottom
    std::vector<glm::dvec3> fluxes_;  // W/m² of each cell
    std::vector<double> cumulated_;   // of all channels
    glm::dvec3 flux_{0.0};
};

}  // namespace kaustik::scene
