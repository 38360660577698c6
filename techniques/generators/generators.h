// SPDX-License-Identifier: MIT
// The caustic generators of a scene (U08, section 4.1): specular objects, each with the reference
// point around which surfaces are sampled and light is stored.
#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Which specular objects share a reference point; shared by all that asks for generators.
struct GeneratorParams {
    int maxGenerators = 8;
    int points = 1;
    template <class R>
    void reflect(R& r) {
        r.field(maxGenerators, "max_generators",
                "Caustic generators: of more specular objects those nearest to one another share "
                "one",
                "", params::range(1, static_cast<int>(transport::kMaxGenerators)));
        r.renamed("most", "max_generators");
        r.field(
            points, "points",
            "Reference points of a generator, each in a part of its box; more for one too large "
            "to be seen from one, such as water",
            "", params::range(1, 16));
    }
};

struct Generator {
    std::string name;      // of its objects
    scene::Bounds bounds;  // world space, m
    // The box's middle; of a sheet, which that would see edge-on, somewhat above it and away from
    // receivers that stand in it.
    glm::dvec3 reference{0.0};
};

// Specular objects that no light can reach directly are left out, and those whose boxes overlap are
// one. Made once a frame, by the first who asks. A scene without
// any that is lit has all of them, one without any has the eye.
[[nodiscard]] const std::vector<Generator>& causticGenerators(FrameBuilder& frame);

// By generator: the receivers that its reference point sees, on the six faces of a cube; specular
// objects hide nothing there.
[[nodiscard]] const std::vector<ReceiverView>& generatorReceivers(FrameBuilder& frame,
                                                                  const Geometry& geometry);

// The block "Generators" of include/surfaces/generators.glsl, as long as the frame lives.
[[nodiscard]] const gl::Buffer& generatorsBlock(FrameBuilder& frame);

// "" of the first, for the names of a generator's resources.
[[nodiscard]] std::string suffixOfGenerator(std::size_t generator);
// The faces around its reference point.
[[nodiscard]] std::vector<render::RasterView> facesAround(const Generator& generator, int side);

}  // namespace kaustik
