// SPDX-License-Identifier: MIT
// The caustic generators of a scene (U08, section 4.1): specular objects, each with the reference
// point around which surfaces are sampled and light is stored.
#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "techniques/generators/culling.h"
#include "techniques/generators/generators_data.h"

namespace kaustik {

// The parameters that decide which specular objects share a reference point. All nodes that ask for
// generators share them.
struct GeneratorParams {
    int maxGenerators = 8;
    int points = 0;
    GeneratorCulling cull = GeneratorCulling::eye;
    template <class R>
    void reflect(R& r) {
        r.field(maxGenerators, "max_generators",
                "Caustic generators: of more specular objects those nearest to one another share "
                "one",
                "", params::range(1, static_cast<int>(generators::kMaxGenerators)))
            .when([](const FrameFacts& facts) {
                const bool mayBeSeveral =
                    facts.needs == nullptr || facts.needs->refractors + facts.needs->reflectors > 1;
                return mayBeSeveral ? "" : "the scene has no more than one specular object";
            });
        r.renamed("most", "max_generators");
        r.field(
            points, "points",
            "Reference points of a generator, each in a part of its box; more for one that is not "
            "seen from one, such as a tank around receivers. 0: as few as see what its light may "
            "reach",
            "", params::range(0, 16));
        r.choice(
             cull, "cull",
             "Which specular objects are no generators. light: those that no light can reach "
             "directly; eye: those, too, whose light cannot come to what the eye sees since a "
             "flat receiver stands in every way, or light is on the other side of it: it is not "
             "followed, and off_screen in the ledger; none: all are",
             {"none", "light", "eye"})
            .when([](const FrameFacts& facts) {
                const bool hasSome =
                    facts.needs == nullptr || facts.needs->refractors + facts.needs->reflectors > 0;
                return hasSome ? "" : "the scene has no specular object";
            });
    }
};

struct Generator {
    std::string name;           // of its objects
    scene::Bounds bounds;       // world space, m
    glm::dvec3 reference{0.0};  // reference_points.h
    std::size_t whole = 0;      // those that share a generator have the same
};

// Those that around.cull leaves out are not among them, and those whose boxes overlap are one. Made
// once a frame, by the first who asks. A scene without any that is lit has all whose light may be
// seen, one without any of these has the eye.
[[nodiscard]] const std::vector<Generator>& causticGenerators(FrameBuilder& frame);

// The receivers that each generator's reference point sees, on the six faces of a cube; specular
// objects hide nothing there.
[[nodiscard]] const std::vector<ReceiverView>& generatorReceivers(FrameBuilder& frame,
                                                                  const Geometry& geometry);

// The block "Generators" of include/surfaces/generators.glsl, as long as the frame lives.
[[nodiscard]] const gl::Buffer& generatorsBlock(FrameBuilder& frame);

// The end of the names of a generator's resources; "" for the first generator.
[[nodiscard]] std::string suffixOfGenerator(std::size_t generator);
// The faces around its reference point.
[[nodiscard]] std::vector<render::RasterView> facesAround(const Generator& generator, int side);

}  // namespace kaustik
