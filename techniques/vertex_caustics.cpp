// SPDX-License-Identifier: MIT
// Caustic maps with a photon a vertex: Shah, Konttinen, Pattanaik (SP05), as WD06 and WD08 compare
// with it.
// As published: two interfaces by estimates, splats wherever they lie, and no search once the
// iteration has ended.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerVertexCaustics(Registry& registry) {
    registry.technique({"vertex_caustics",
                        "Caustic maps with one photon a vertex of the specular objects.",
                        "Shah, Konttinen, Pattanaik (SP05)",
                        {{"specular", "two_interfaces"},
                         {"trace", "background"},
                         {"reconstruct.space", "light"},
                         {"gather", "project"},
                         {"view", "image_space"},
                         {"emit.photons", "512x512"},
                         {"emit", "vertices"},
                         {"trace.background.step", "distance"},
                         {"reconstruct", "fixed"}},
                        {{"specular.two_interfaces.distance", "estimates"},
                         {"trace.background.steps", "0"},
                         {"reconstruct.fixed.edges", "crossed"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
