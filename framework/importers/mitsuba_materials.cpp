// SPDX-License-Identifier: MIT
// BSDFs of a Mitsuba scene as the nearest material that there is. What is around a BSDF (twosided,
// mask, bumpmap) is taken off, with a note where that changes the picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/names.h"
#include "framework/importers/mitsuba_parts.h"

namespace kaustik::scene {
namespace {

// By number or by name; `name` is given where the property is not.
double iorOf(const MitsubaElement& bsdf, const char* property, const char* name) {
    const MitsubaElement* const found = bsdf.child(property);
    const std::string value = found != nullptr ? found->required("value") : name;
    const std::string& place = found != nullptr ? found->place : bsdf.place;
    if (const auto ior = namedIor(value)) return *ior;
    if (found != nullptr && found->tag == "string") {
        const std::string suggestion = didYouMean(value, iorNames());
        failAt(place, fmt::format("no index of refraction is known for '{}'{}", value,
                                  suggestion.empty() ? "; give a number." : suggestion));
    }
    const double ior = parseOneNumber(value, place);
    if (!(ior > 0.0)) failAt(place, fmt::format("an index of refraction is above 0, not {}.", ior));
    return ior;
}

// Whether a body of the scene has this index: then what has it outside lies in that body.
bool isIndexOfABody(const MitsubaElement& element, double ior) {
    if (element.tag == "bsdf" && element.type().ends_with("dielectric") &&
        std::abs(iorOf(element, "int_ior", "bk7") - ior) < 1e-3)
        return true;
    return std::any_of(element.children.begin(), element.children.end(),
                       [&](const MitsubaElement& child) { return isIndexOfABody(child, ior); });
}

// An index here is against vacuum, and bodies lie in each other.
float relativeIor(MitsubaImport& importer, const MitsubaElement& bsdf, const char* otherwise) {
    const double inside = iorOf(bsdf, "int_ior", otherwise);
    const double outside = iorOf(bsdf, "ext_ior", "air");
    const bool isInAir = outside < 1.01;
    const bool isNested = !isInAir && isIndexOfABody(importer.document.root, outside);
    const double ior = isNested ? inside : inside / outside;
    if (isNested)
        importer.change(bsdf, "its index is against vacuum; it must lie in the other body");
    if (ior < 0.999)
        importer.change(bsdf, "the index inside is below that outside; it is taken for 1");
    return static_cast<float>(std::clamp(ior, 1.0, 10.0));
}

void makeDielectric(MitsubaImport& importer, const MitsubaElement& bsdf, Material& material) {
    material.kind = MaterialKind::dielectric;
    material.albedo = glm::vec3(0.0f);
    material.ior = relativeIor(importer, bsdf, "bk7");
    if (bsdf.type() == "roughdielectric") {
        static_cast<void>(bsdf.child("alpha"));
        static_cast<void>(bsdf.child("distribution"));
        importer.change(bsdf, "it is as smooth as a mirror; there is no rough glass");
    }
}

double roughnessOf(MitsubaImport& importer, const MitsubaElement& bsdf) {
    static_cast<void>(bsdf.child("distribution"));
    const double u = evenColor(importer, bsdf, "alpha_u", glm::dvec3(0.1)).r;
    const double v = evenColor(importer, bsdf, "alpha_v", glm::dvec3(u)).r;
    return evenColor(importer, bsdf, "alpha", glm::dvec3(std::sqrt(std::max(u * v, 0.0)))).r;
}

glm::dvec3 conductorReflectance(MitsubaImport& importer, const MitsubaElement& bsdf) {
    const glm::dvec3 tint = evenColor(importer, bsdf, "specular_reflectance", glm::dvec3(1.0));
    const std::string metal = bsdf.text("material", "");
    if (!metal.empty()) {
        const auto reflectance = namedMetal(metal);
        if (!reflectance) {
            importer.change(bsdf,
                            fmt::format("the metal '{}' is not known; it reflects all", metal));
        }
        return tint * reflectance.value_or(glm::dvec3(1.0));
    }
    if (bsdf.child("eta") == nullptr && bsdf.child("k") == nullptr) return tint;
    const double outside = bsdf.child("ext_eta") != nullptr ? iorOf(bsdf, "ext_eta", "air") : 1.0;
    return tint * metalReflectance(evenColor(importer, bsdf, "eta", glm::dvec3(0.0)) / outside,
                                   evenColor(importer, bsdf, "k", glm::dvec3(1.0)) / outside);
}

void makeConductor(MitsubaImport& importer, const MitsubaElement& bsdf, Material& material) {
    const glm::dvec3 reflectance = conductorReflectance(importer, bsdf);
    material.kind = MaterialKind::mirror;
    material.albedo = reflectanceOf(reflectance);
    if (bsdf.type() == "conductor") return;
    const double alpha = roughnessOf(importer, bsdf);
    if (alpha < kSmoothAlpha) {
        importer.change(bsdf, fmt::format("it is a mirror, as its roughness is only {}", alpha));
        return;
    }
    setGlossy(material, glm::dvec3(0.0), reflectance, exponentOfRoughness(alpha));
    importer.change(bsdf, fmt::format("it is glossy with exponent {:.0f}", material.exponent));
}

void makePlastic(MitsubaImport& importer, const MitsubaElement& bsdf, ForeignMaterial& foreign) {
    const ForeignColor diffuse =
        surfaceColor(importer, bsdf, "diffuse_reflectance", glm::dvec3(0.5));
    setColor(foreign, diffuse);
    if (bsdf.type() == "phong") {
        setGlossy(foreign.material, diffuse.color,
                  evenColor(importer, bsdf, "specular_reflectance", glm::dvec3(0.2)),
                  bsdf.number("exponent", 30.0));
    } else {
        const double coat = dielectricReflectance(relativeIor(importer, bsdf, "polypropylene"));
        static_cast<void>(bsdf.child("nonlinear"));
        const bool isSmooth = bsdf.type() == "plastic";
        setGlossy(foreign.material, diffuse.color,
                  coat * evenColor(importer, bsdf, "specular_reflectance", glm::dvec3(1.0)),
                  isSmooth ? 10000.0 : exponentOfRoughness(roughnessOf(importer, bsdf)));
    }
    // The second colour of a pattern has the same lobe above it.
    foreign.material.patternAlbedo =
        glm::min(foreign.material.patternAlbedo, 0.9999f * (1.0f - foreign.material.specular));
    importer.change(bsdf, fmt::format("it is glossy with exponent {:.0f}, and reflects no more at "
                                      "grazing angles",
                                      foreign.material.exponent));
}

// The mixture of all of them, by what it is most.
void makePrincipled(MitsubaImport& importer, const MitsubaElement& bsdf, ForeignMaterial& foreign) {
    const ForeignColor base = surfaceColor(importer, bsdf, "base_color", glm::dvec3(0.5));
    const double metallic = evenColor(importer, bsdf, "metallic", glm::dvec3(0.0)).r;
    const double transmission = evenColor(importer, bsdf, "spec_trans", glm::dvec3(0.0)).r;
    const double roughness = evenColor(importer, bsdf, "roughness", glm::dvec3(0.5)).r;
    setColor(foreign, base);
    if (transmission > 0.5) {
        foreign.material.kind = MaterialKind::dielectric;
        foreign.material.ior = static_cast<float>(std::clamp(bsdf.number("eta", 1.5), 1.0, 10.0));
        foreign.image.reset();
        importer.change(bsdf, "it is smooth clear glass");
    } else if (metallic > 0.5 && roughness * roughness < kSmoothAlpha) {
        foreign.material.kind = MaterialKind::mirror;
        foreign.image.reset();
        importer.change(bsdf, "it is a mirror");
    } else if (metallic > 0.5) {
        setGlossy(foreign.material, glm::dvec3(0.0), base.color,
                  exponentOfRoughness(roughness * roughness));
        importer.change(bsdf, "it is glossy");
    } else {
        importer.change(bsdf, "it is its base colour alone, without a lobe");
    }
}

// The BSDF that another one is around, with a note of what that one would have changed.
const MitsubaElement& innerOf(MitsubaImport& importer, const MitsubaElement& bsdf) {
    const MitsubaElement* inner = nullptr;
    int count = 0;
    for (const MitsubaElement& child : bsdf.children) {
        if (child.tag != "bsdf" && child.tag != "ref") continue;
        const MitsubaElement& target = importer.document.resolve(child);
        if (target.tag != "bsdf") continue;
        if (inner == nullptr) inner = &target;
        ++count;
    }
    if (inner == nullptr) failAt(bsdf.place, fmt::format("{} has no bsdf in it.", bsdf.subject()));
    if (count > 1) importer.change(bsdf, "only the first of its bsdfs is taken");
    if (bsdf.type() == "mask") importer.change(bsdf, "it is opaque everywhere");
    if (bsdf.type().ends_with("coating")) importer.change(bsdf, "the coat on it is left out");
    return *inner;
}

// Of the surface around another bsdf's; diffusers stay as flat as their triangles.
void setNormalMap(MitsubaImport& importer, const MitsubaElement& bsdf, ForeignMaterial& foreign) {
    const MitsubaElement* const child = bsdf.child("normalmap");
    if (child == nullptr) return importer.change(bsdf, "it names no normal map");
    const MitsubaElement& texture = importer.document.resolve(*child);
    if (isReceiver(foreign.material.kind))
        return importer.leaveOut(texture, "only glass and mirrors have normal maps");
    const ForeignColor picture = surfaceColor(importer, bsdf, "normalmap", glm::dvec3(0.5));
    if (!picture.image) return importer.leaveOut(texture, "a normal map is a bitmap");
    foreign.normalMap = picture.image;
    foreign.material.uvScale = glm::vec2(picture.uvScale);
    foreign.turnsTexture = picture.turnsTexture;
}

void makeMaterial(MitsubaImport& importer, const MitsubaElement& bsdf, ForeignMaterial& foreign,
                  std::string& whyNot, int depth) {
    const std::string& type = bsdf.type();
    if (depth > kMaxNesting) failAt(bsdf.place, "bsdfs refer to each other without an end.");
    if (type == "twosided" || type == "mask" || type == "bumpmap" || type == "normalmap" ||
        type == "blendbsdf" || type == "coating" || type == "roughcoating" || type == "bump") {
        const MitsubaElement& inner = innerOf(importer, bsdf);
        makeMaterial(importer, inner, foreign, whyNot, depth + 1);
        if (type == "normalmap") setNormalMap(importer, bsdf, foreign);
        return;
    }
    if (type == "dielectric" || type == "roughdielectric") {
        makeDielectric(importer, bsdf, foreign.material);
    } else if (type == "thindielectric") {
        static_cast<void>(bsdf.child("int_ior"));
        static_cast<void>(bsdf.child("ext_ior"));
        whyNot = "thin glass lets light pass straight on, and has no counterpart";
    } else if (type == "null") {
        whyNot = "it has no surface";
    } else if (type == "conductor" || type == "roughconductor") {
        makeConductor(importer, bsdf, foreign.material);
    } else if (type == "diffuse") {
        setColor(foreign, surfaceColor(importer, bsdf, "reflectance", glm::dvec3(0.5)));
    } else if (type == "plastic" || type == "roughplastic" || type == "phong") {
        makePlastic(importer, bsdf, foreign);
    } else if (type == "principled") {
        makePrincipled(importer, bsdf, foreign);
    } else {
        importer.leaveOut(bsdf, "there is no such material; it is a grey diffuser");
    }
}

// Beer's law inside a body.
void setInside(MitsubaImport& importer, const MitsubaElement& element, Material& material) {
    const std::optional<Medium> medium = mediumOf(importer, element);
    if (!medium) return;
    if (material.kind != MaterialKind::dielectric) {
        return importer.leaveOut(element, "only in glass and water there is a medium of its own");
    }
    material.absorptionPerMeter = medium->absorptionPerMeter;
    if (medium->scatteringPerMeter != glm::vec3(0.0f))
        importer.leaveOut(element, "it scatters, and inside a body there is only absorption");
}

}  // namespace

std::optional<std::uint32_t> materialOf(MitsubaImport& importer, const MitsubaElement& bsdf,
                                        const MitsubaElement* medium, std::string& whyNot) {
    const auto found = importer.materials.find({&bsdf, medium});
    if (found != importer.materials.end()) return found->second;
    ForeignMaterial foreign;
    foreign.material.name = importer.nameOf(bsdf);
    makeMaterial(importer, bsdf, foreign, whyNot, 0);
    if (!whyNot.empty()) return std::nullopt;
    if (medium != nullptr) setInside(importer, *medium, foreign.material);
    const auto index = static_cast<std::uint32_t>(importer.scene.materials.size());
    importer.scene.materials.push_back(std::move(foreign));
    importer.materials[{&bsdf, medium}] = index;
    return index;
}

std::uint32_t defaultMaterial(MitsubaImport& importer) {
    const auto found = importer.materials.find({nullptr, nullptr});
    if (found != importer.materials.end()) return found->second;
    const auto index = static_cast<std::uint32_t>(importer.scene.materials.size());
    importer.scene.materials.push_back({});
    importer.scene.materials.back().material.name = "default";
    importer.materials[{nullptr, nullptr}] = index;
    return index;
}

}  // namespace kaustik::scene
