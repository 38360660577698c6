// SPDX-License-Identifier: MIT
#include "framework/reference/appearance.h"

#include <algorithm>
#include <cmath>

#include "framework/scene/environment.h"
#include "framework/scene/texture.h"
#include "framework/transport/brdf.h"

namespace kaustik::reference {
namespace {

enum class Edge { repeat, clamp };

int texelIndex(double index, int count, Edge edge) {
    if (edge == Edge::clamp) return static_cast<int>(std::clamp(index, 0.0, count - 1.0));
    const double turns = std::floor(index / count);
    return std::min(static_cast<int>(index - turns * count), count - 1);
}

// `position`: (0, 0) is the lower left, (1, 1) the upper right.
glm::dvec3 sample(const Image& image, const glm::dvec2& position, Edge columns, Edge rows) {
    const double x = position.x * image.width - 0.5;
    const double y = (1.0 - position.y) * image.height - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const double column = left + (i & 1);
        const double row = top + (i >> 1);
        const double weight = (1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row));
        for (int c = 0; c < 3; ++c) {
            sum[c] +=
                weight * static_cast<double>(image.at(texelIndex(column, image.width, columns),
                                                      texelIndex(row, image.height, rows), c));
        }
    }
    return sum;
}

double fraction(double value) {
    return value - std::floor(value);
}

// The second colour's share; see include/surfaces/surface.glsl.
bool isSecondColor(scene::Pattern pattern, const glm::dvec2& p) {
    if (pattern == scene::Pattern::checker) {
        return (fraction(0.5 * p.x) > 0.5) != (fraction(0.5 * p.y) > 0.5);
    }
    constexpr double kJoint = 0.04;  // of a tile's side
    return pattern == scene::Pattern::tiles && (fraction(p.x) < kJoint || fraction(p.y) < kJoint);
}

}  // namespace

Appearance::Appearance(const scene::Scene& scene) : scene_(scene), images_(scene.images.size()) {
    for (std::size_t i = 0; i < images_.size(); ++i)
        images_[i] = scene::decodeTexture(scene.images[i]);
}

glm::dvec3 Appearance::albedo(std::uint32_t index, const glm::dvec2& uv) const {
    const scene::Material& material = scene_.materials[index];
    const glm::dvec2 p = uv * glm::dvec2(material.uvScale);
    glm::dvec3 albedo(isSecondColor(material.pattern, p) ? material.patternAlbedo
                                                         : material.albedo);
    if (material.image >= 0)
        albedo *= sample(images_[static_cast<std::size_t>(material.image)], p, Edge::repeat,
                         Edge::repeat);
    return albedo;
}

glm::dvec3 Appearance::mappedVector(std::uint32_t index, const glm::dvec2& uv) const {
    const scene::Material& material = scene_.materials[index];
    const glm::dvec3 vector = sample(images_[static_cast<std::size_t>(material.normalMap)],
                                     uv * glm::dvec2(material.uvScale), Edge::repeat, Edge::repeat);
    const auto scale = static_cast<double>(material.normalScale);
    return {vector.x * scale, vector.y * scale, vector.z};
}

glm::dvec2 Appearance::normalTexels(std::uint32_t index, const glm::dvec2& uvStep) const {
    const scene::Material& material = scene_.materials[index];
    const Image& image = images_[static_cast<std::size_t>(material.normalMap)];
    return uvStep * glm::dvec2(material.uvScale) * glm::dvec2(image.width, image.height);
}

glm::dvec3 Appearance::brdf(std::uint32_t index, const glm::dvec2& uv, const glm::dvec3& normal,
                            const glm::dvec3& toLight, const glm::dvec3& toEye) const {
    const scene::Material& material = scene_.materials[index];
    return transport::receiverBrdf(albedo(index, uv), glm::dvec3(material.specular),
                                   static_cast<double>(material.exponent), normal, toLight, toEye);
}

glm::dvec3 Appearance::spotColor(const scene::Light& light, const glm::dvec3& direction) const {
    if (light.image < 0) return glm::dvec3(1.0);
    return sample(images_[static_cast<std::size_t>(light.image)],
                  spotImagePosition(light, direction), Edge::clamp, Edge::clamp);
}

glm::dvec3 Appearance::environment(const glm::dvec3& direction) const {
    const glm::dvec3 background(scene_.backgroundRadiance);
    if (scene_.environmentImage < 0) return background;
    return background * sample(images_[static_cast<std::size_t>(scene_.environmentImage)],
                               environmentPosition(scene_, direction), Edge::repeat, Edge::clamp);
}

}  // namespace kaustik::reference
