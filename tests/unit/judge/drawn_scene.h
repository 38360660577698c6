// SPDX-License-Identifier: MIT
// A drawn stand-in for a scene: direct light with a shadow, a bright ring of one class of light, a
// dim wide spot of another and a streak of a third, all as formulas over the picture, so that any
// mistake can be drawn exactly.
#pragma once

#include <cmath>
#include <functional>
#include <random>

#include "framework/judge/judge.h"

namespace kaustik::test {

struct Drawing {
    double direct = 1.0;
    double ring = 1.0;  // factors of the classes
    double spot = 1.0;
    double streak = 1.0;
    double index = 1.5;  // the ring's radius grows with it
    double fill = 0.0;
    glm::dvec2 shift{0.0};  // pixels, of what is seen
    double zoom = 1.0;      // of what is seen, about the middle
    double roll = 0.0;      // degrees, of the camera about its line of sight
    // Of a camera that looks from aslant: places are divided by 1 + keystone · place from the
    // middle in halves of the height.
    glm::dvec2 keystone{0.0};
    bool isFlippedX = false;
    bool isFlippedY = false;
    int width = 96;
    int height = 72;
    glm::dvec2 corner{0.0};       // of a crop, in pixels
    double pixelsPerPixel = 1.0;  // of the usual size, in one of this picture's
};

inline constexpr int kDrawnWidth = 96;
inline constexpr int kDrawnHeight = 72;

// Everything at a place of the usual picture, in its pixels from its top left corner.
struct DrawnLight {
    double albedo = 0.0;
    double direct = 0.0;
    double ring = 0.0;
    double spot = 0.0;
    double streak = 0.0;
};
inline DrawnLight drawnAt(const glm::dvec2& p, double index) {
    DrawnLight light;
    const bool isDark =
        (static_cast<int>(std::floor(p.x / 12.0)) + static_cast<int>(std::floor(p.y / 12.0))) % 2 !=
        0;
    light.albedo = isDark ? 0.45 : 0.7;
    const glm::dvec2 middle(56.0, 34.0);
    const double radius = glm::length(p - middle);
    const bool isShadow = radius < 24.0;
    light.direct = isShadow ? 0.0 : 90.0 + 0.5 * p.x - 0.3 * p.y;
    const double ring = 12.0 + 60.0 * (index - 1.5);
    light.ring = 320.0 * std::exp(-0.5 * std::pow((radius - ring) / 1.6, 2.0)) +
                 25.0 * std::exp(-radius / 9.0);
    light.spot =
        22.0 * std::exp(-0.5 * std::pow(glm::length(p - glm::dvec2(40.0, 45.0)) / 9.0, 2.0));
    const double along = p.x - 70.0 + 0.5 * (p.y - 20.0);
    light.streak = 60.0 * std::exp(-0.5 * std::pow(along / 2.5, 2.0) -
                                   0.5 * std::pow((p.y - 20.0) / 8.0, 2.0));
    return light;
}

// The mean of a quantity over each pixel.
inline Image drawn(const Drawing& drawing,
                   const std::function<double(const DrawnLight&)>& quantity) {
    Image image(drawing.width, drawing.height, 3);
    constexpr int kSide = 5;
    const glm::dvec2 middle(0.5 * kDrawnWidth, 0.5 * kDrawnHeight);
    for (int y = 0; y < drawing.height; ++y) {
        for (int x = 0; x < drawing.width; ++x) {
            double sum = 0.0;
            for (int i = 0; i < kSide * kSide; ++i) {
                glm::dvec2 p(x + (i % kSide + 0.5) / kSide, y + (i / kSide + 0.5) / kSide);
                if (drawing.isFlippedX) p.x = drawing.width - p.x;
                if (drawing.isFlippedY) p.y = drawing.height - p.y;
                p = drawing.corner + p * drawing.pixelsPerPixel - drawing.shift;
                p = middle + (p - middle) / drawing.zoom;
                const double roll = drawing.roll * std::acos(-1.0) / 180.0;
                const glm::dvec2 q = p - middle;
                p = middle + glm::dvec2(std::cos(roll) * q.x - std::sin(roll) * q.y,
                                        std::sin(roll) * q.x + std::cos(roll) * q.y) /
                                 (1.0 + glm::dot(drawing.keystone, q) / middle.y);
                sum += quantity(drawnAt(p, drawing.index));
            }
            const double value = sum / (kSide * kSide);
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(value * (1.0 - 0.1 * c));
        }
    }
    return image;
}

// Of a standard deviation of `relative` of the light and of 2 units of it.
inline void addNoise(Image& image, double relative, double exposure, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (float& value : image.values) {
        const auto light = static_cast<double>(value);
        value = static_cast<float>(light + normal(random) * relative * (light + 2.0 * exposure));
    }
}

inline Image theirPicture(const Drawing& drawing, double exposure, double noise = 0.01,
                          unsigned seed = 7) {
    const double pi = std::acos(-1.0);
    Image image = drawn(drawing, [&](const DrawnLight& light) {
        return exposure * light.albedo / pi *
               (drawing.direct * light.direct + drawing.ring * light.ring +
                drawing.spot * light.spot + drawing.streak * light.streak + drawing.fill);
    });
    addNoise(image, noise, exposure, seed);
    return image;
}

inline judge::Subject drawnSubject(Image theirs) {
    const double pi = std::acos(-1.0);
    const Drawing usual;
    const auto radiance = [&](const Drawing& drawing, double DrawnLight::*part) {
        return drawn(drawing,
                     [&](const DrawnLight& light) { return light.albedo / pi * light.*part; });
    };
    judge::Subject subject;
    subject.scene = "drawn";
    subject.theirsName = "theirs.exr";
    subject.theirs = std::move(theirs);
    subject.direct = radiance(usual, &DrawnLight::direct);
    unsigned seed = 100;
    const auto addClass = [&](const char* name, double DrawnLight::*part) {
        Image image = radiance(usual, part);
        Image error = image;
        for (float& value : error.values)
            value = 0.004f * value + 0.002f;
        std::mt19937 random(seed++);
        std::normal_distribution<double> normal;
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            image.values[i] +=
                static_cast<float>(normal(random) * static_cast<double>(error.values[i]));
        }
        subject.classes.push_back({name, std::move(image), std::move(error)});
    };
    addClass("TT", &DrawnLight::ring);
    addClass("TRT", &DrawnLight::spot);
    addClass("R", &DrawnLight::streak);
    subject.fill = drawn(usual, [&](const DrawnLight& light) { return light.albedo / pi; });
    subject.mask = Image(kDrawnWidth, kDrawnHeight, 1);
    std::fill(subject.mask.values.begin(), subject.mask.values.end(), 1.0f);
    subject.hasGlass = Image(kDrawnWidth, kDrawnHeight, 1);
    subject.verticalFovDegrees = 40.0;
    subject.indices = {{"glass", 1.5}};
    const Image ring = radiance(usual, &DrawnLight::ring);
    for (const double amount : {-0.01, 0.01, -0.03, 0.03}) {
        Drawing other;
        other.index += amount;
        judge::Cause index;
        index.name = "the index of refraction of 'glass'";
        index.amount = amount;
        index.least = 0.002;
        index.radiance = radiance(other, &DrawnLight::ring);
        for (std::size_t i = 0; i < ring.values.size(); ++i)
            index.radiance.values[i] -= ring.values[i];
        subject.causes.push_back(std::move(index));
    }
    return subject;
}

}  // namespace kaustik::test
