// SPDX-License-Identifier: MIT
// BSDFs of a Tungsten scene as the nearest material that there is, and its media.
#include <fmt/format.h>

#include <algorithm>

#include "framework/importers/tungsten_parts.h"

namespace kaustik::scene {
namespace {

double iorOf(const JsonTree& bsdf) {
    const double ior = jsonNumber(bsdf, "ior", 1.5);
    if (!(ior > 0.0)) failAt(bsdf.place, "an index of refraction is above 0.");
    return std::clamp(ior, 1.0, 10.0);
}

double roughnessOf(TungstenImport& importer, const JsonTree& bsdf) {
    static_cast<void>(bsdf.find("distribution"));
    return evenColor(importer, bsdf, "roughness", glm::dvec3(0.1)).r;
}

void makeDielectric(TungstenImport& importer, const JsonTree& bsdf, Material& material) {
    material.kind = MaterialKind::dielectric;
    material.albedo = glm::vec3(0.0f);
    material.ior = static_cast<float>(iorOf(bsdf));
    if (evenColor(importer, bsdf, "albedo", glm::dvec3(1.0)) != glm::dvec3(1.0))
        importer.change("bsdf", bsdf, "its tint is left out; only a medium inside colours glass");
    if (!jsonFlag(bsdf, "enable_refraction", true))
        importer.change("bsdf", bsdf, "it refracts all the same");
    if (jsonText(bsdf, "type") != "rough_dielectric") return;
    static_cast<void>(roughnessOf(importer, bsdf));
    importer.change("bsdf", bsdf, "it is as smooth as a mirror; there is no rough glass");
}

void makeConductor(TungstenImport& importer, const JsonTree& bsdf, Material& material) {
    glm::dvec3 reflectance(1.0);
    if (bsdf.find("eta") != nullptr || bsdf.find("k") != nullptr) {
        reflectance = metalReflectance(jsonVector(bsdf, "eta", glm::dvec3(0.2)),
                                       jsonVector(bsdf, "k", glm::dvec3(4.0)));
    } else {
        const std::string metal = jsonText(bsdf, "material", "Cu");
        const auto known = namedMetal(metal);
        if (!known) {
            importer.change("bsdf", bsdf,
                            fmt::format("the metal '{}' is not known; it reflects all", metal));
        }
        reflectance = known.value_or(reflectance);
    }
    reflectance *= evenColor(importer, bsdf, "albedo", glm::dvec3(1.0));
    material.kind = MaterialKind::mirror;
    material.albedo = reflectanceOf(reflectance);
    if (jsonText(bsdf, "type") == "conductor") return;
    const double alpha = roughnessOf(importer, bsdf);
    if (alpha < kSmoothAlpha) {
        importer.change("bsdf", bsdf,
                        fmt::format("it is a mirror, as its roughness is only {}", alpha));
        return;
    }
    setGlossy(material, glm::dvec3(0.0), reflectance, exponentOfRoughness(alpha));
    importer.change("bsdf", bsdf,
                    fmt::format("it is glossy with exponent {:.0f}", material.exponent));
}

void makePlastic(TungstenImport& importer, const JsonTree& bsdf, ForeignMaterial& foreign) {
    const ForeignColor albedo = surfaceColor(importer, bsdf, "albedo", glm::dvec3(1.0));
    setColor(foreign, albedo);
    const std::string type = jsonText(bsdf, "type");
    if (type == "phong") {
        const double diffuse = std::clamp(jsonNumber(bsdf, "diffuse_ratio", 0.2), 0.0, 1.0);
        setGlossy(foreign.material, diffuse * albedo.color, (1.0 - diffuse) * albedo.color,
                  jsonNumber(bsdf, "exponent", 64.0));
    } else {
        setGlossy(foreign.material, albedo.color, glm::dvec3(dielectricReflectance(iorOf(bsdf))),
                  type == "plastic" ? 10000.0 : exponentOfRoughness(roughnessOf(importer, bsdf)));
    }
    foreign.material.patternAlbedo =
        glm::min(foreign.material.patternAlbedo, 0.9999f * (1.0f - foreign.material.specular));
    importer.change("bsdf", bsdf,
                    fmt::format("it is glossy with exponent {:.0f}, and reflects no more "
                                "at grazing angles",
                                foreign.material.exponent));
}

// What a key of a bsdf or a primitive means: a name, or the thing itself.
const JsonTree& bsdfAt(const TungstenImport& importer, const JsonTree& node, const char* key) {
    const JsonTree* const found = node.find(key);
    if (found == nullptr) failAt(node.place, fmt::format("a '{}' is needed here.", key));
    if (found->as<JsonTree::Object>() != nullptr) return *found;
    return namedNode(importer.root, "bsdfs", *found);
}

void makeMaterial(TungstenImport& importer, const JsonTree& bsdf, ForeignMaterial& foreign,
                  std::string& whyNot, int depth) {
    if (depth > kMaxNesting) failAt(bsdf.place, "bsdfs refer to each other without an end.");
    const std::string type = jsonText(bsdf, "type");
    const auto takeInner = [&](const char* key, const char* how) {
        importer.change("bsdf", bsdf, how);
        makeMaterial(importer, bsdfAt(importer, bsdf, key), foreign, whyNot, depth + 1);
    };
    if (type == "lambert" || type == "oren_nayar") {
        setColor(foreign, surfaceColor(importer, bsdf, "albedo", glm::dvec3(1.0)));
        if (type == "oren_nayar") importer.change("bsdf", bsdf, "it is an ideal diffuser");
    } else if (type == "dielectric" || type == "rough_dielectric") {
        makeDielectric(importer, bsdf, foreign.material);
    } else if (type == "mirror") {
        foreign.material.kind = MaterialKind::mirror;
        foreign.material.albedo =
            reflectanceOf(evenColor(importer, bsdf, "albedo", glm::dvec3(1.0)));
    } else if (type == "conductor" || type == "rough_conductor") {
        makeConductor(importer, bsdf, foreign.material);
    } else if (type == "plastic" || type == "rough_plastic" || type == "phong") {
        makePlastic(importer, bsdf, foreign);
    } else if (type == "thinsheet") {
        bsdf.markUsed();
        whyNot = "a thin sheet lets light pass straight on, and has no counterpart";
    } else if (type == "null" || type == "forward") {
        bsdf.markUsed();
        whyNot = "it has no surface";
    } else if (type == "transparency") {
        takeInner("base", "it is opaque everywhere");
    } else if (type == "smooth_coat" || type == "rough_coat") {
        takeInner("substrate", "the coat on it is left out");
    } else if (type == "mixed") {
        takeInner("bsdf0", "only the first of its bsdfs is taken");
    } else {
        importer.leaveOut("bsdf", bsdf, "there is no such material; it is a grey diffuser");
    }
}

}  // namespace

const JsonTree* mediumNode(const TungstenImport& importer, const JsonTree& node, const char* key) {
    const JsonTree* const found = node.find(key);
    if (found == nullptr || found->as<JsonTree::Object>() != nullptr) return found;
    const auto* const name = found->as<std::string>();
    if (name != nullptr && name->empty()) return nullptr;
    return &namedNode(importer.root, "media", *found);
}

std::optional<Medium> mediumOf(TungstenImport& importer, const JsonTree& node) {
    if (jsonText(node, "type") != "homogeneous") {
        importer.leaveOut("medium", node, "only homogeneous media have a counterpart");
        return std::nullopt;
    }
    const double density = std::max(jsonNumber(node, "density", 1.0), 0.0);
    Medium medium;
    medium.absorptionPerMeter =
        glm::vec3(density * glm::max(jsonVector(node, "sigma_a", glm::dvec3(0.0)), 0.0));
    medium.scatteringPerMeter =
        glm::vec3(density * glm::max(jsonVector(node, "sigma_s", glm::dvec3(0.0)), 0.0));
    if (const JsonTree* const phase = node.find("phase_function")) {
        const std::string type = jsonText(*phase, "type");
        if (type == "henyey_greenstein") {
            medium.anisotropy =
                static_cast<float>(std::clamp(jsonNumber(*phase, "g", 0.0), -0.999, 0.999));
        } else if (type != "isotropic") {
            importer.leaveOut("phase function", *phase, "it scatters in all directions");
        }
    }
    return medium;
}

std::optional<std::uint32_t> materialOf(TungstenImport& importer, const JsonTree& primitive,
                                        std::string& whyNot) {
    const JsonTree& bsdf = bsdfAt(importer, primitive, "bsdf");
    const JsonTree* const inside = mediumNode(importer, primitive, "int_medium");
    static_cast<void>(mediumNode(importer, primitive, "ext_medium"));
    const auto found = importer.materials.find({&bsdf, inside});
    if (found != importer.materials.end()) return found->second;
    ForeignMaterial foreign;
    foreign.material.name = importer.nameOf(bsdf);
    makeMaterial(importer, bsdf, foreign, whyNot, 0);
    if (!whyNot.empty()) return std::nullopt;
    const std::optional<Medium> medium =
        inside != nullptr ? mediumOf(importer, *inside) : std::nullopt;
    if (medium && foreign.material.kind != MaterialKind::dielectric) {
        importer.leaveOut("medium", *inside,
                          "only in glass and water there is a medium of its own");
    } else if (medium) {
        foreign.material.absorptionPerMeter = medium->absorptionPerMeter;
        if (medium->scatteringPerMeter != glm::vec3(0.0f)) {
            importer.leaveOut("medium", *inside,
                              "it scatters, and inside a body there is only absorption");
        }
    }
    const auto index = static_cast<std::uint32_t>(importer.scene.materials.size());
    importer.scene.materials.push_back(std::move(foreign));
    importer.materials[{&bsdf, inside}] = index;
    return index;
}

}  // namespace kaustik::scene
