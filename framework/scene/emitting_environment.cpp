// SPDX-License-Identifier: MIT
#include "framework/scene/emitting_environment.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/scene/texture.h"

namespace kaustik::scene {
namespace {

constexpr int kColumns = 512;
constexpr int kRows = 256;

double total(const glm::dvec3& flux) {
    return flux.r + flux.g + flux.b;
}

// Of the pixels that a cell covers; rows of a picture go down, those of cells up.
glm::dvec3 meanOf(const Image& image, int column, int row) {
    const auto edge = [](int cell, int cells, int pixels) {
        return static_cast<int>(std::int64_t{cell} * pixels / cells);
    };
    const int left = edge(column, kColumns, image.width);
    const int right = std::max(edge(column + 1, kColumns, image.width), left + 1);
    const int top = edge(kRows - 1 - row, kRows, image.height);
    const int bottom = std::max(edge(kRows - row, kRows, image.height), top + 1);
    glm::dvec3 sum(0.0);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x)
            sum += glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
    }
    return sum / static_cast<double>((right - left) * (bottom - top));
}

}  // namespace

EmittingEnvironment::EmittingEnvironment(const Scene& scene)
    : turnRadians_(glm::radians(scene.environmentTurnDegrees)), columns_(kColumns), rows_(kRows) {
    const bool hasImage = scene.environmentImage >= 0;
    const Image image =
        hasImage ? decodeTexture(scene.images[static_cast<std::size_t>(scene.environmentImage)])
                 : Image();
    double sum = 0.0;
    for (int row = 0; row < rows_; ++row) {
        const auto sineAt = [&](int edge) {
            return std::sin(glm::pi<double>() * (static_cast<double>(edge) / rows_ - 0.5));
        };
        const double solidAngle =
            glm::two_pi<double>() / columns_ * (sineAt(row + 1) - sineAt(row));
        for (int column = 0; column < columns_; ++column) {
            const glm::dvec3 picture = hasImage ? meanOf(image, column, row) : glm::dvec3(1.0);
            fluxes_.push_back(glm::dvec3(scene.backgroundRadiance) * picture * solidAngle);
            flux_ += fluxes_.back();
            sum += total(fluxes_.back());
            cumulated_.push_back(sum);
        }
    }
}

std::size_t EmittingEnvironment::at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
}

// The inverse of environmentPosition().
glm::dvec3 EmittingEnvironment::directionOf(double column, double row) const {
    const double longitude = (column / columns_ - 0.5) * glm::two_pi<double>() - turnRadians_;
    const double latitude = (row / rows_ - 0.5) * glm::pi<double>();
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            -std::cos(longitude) * std::cos(latitude)};
}

double EmittingEnvironment::weightOf(const Area& area) const {
    double sum = 0.0;
    for (int row = area.bottom; row < area.top; ++row) {
        for (int column = area.left; column < area.right; ++column)
            sum += total(fluxes_[at(column, row)]);
    }
    return sum;
}

void EmittingEnvironment::addParts(const Area& area, int count, std::vector<Part>& all) const {
    const int width = area.right - area.left;
    const int height = area.top - area.bottom;
    if (count <= 1 || width * height == 1) {
        Part part;
        for (int row = area.bottom; row < area.top; ++row) {
            for (int column = area.left; column < area.right; ++column) {
                const glm::dvec3& flux = fluxes_[at(column, row)];
                part.fluxPerSquareMeter += flux;
                part.direction += total(flux) * directionOf(column + 0.5, row + 0.5);
            }
        }
        const double length = glm::length(part.direction);
        if (!(length > 0.0)) return;
        // Unit directions of mean m are 1 - |m|² from it in the mean square, and a square cell's
        // light a sixth of its side's square; a disc's is half of its radius' square.
        const double mean = std::min(length / total(part.fluxPerSquareMeter), 1.0);
        const double cell = glm::pi<double>() / rows_;
        part.radius = std::sqrt(2.0 * (1.0 - mean * mean + cell * cell / 6.0));
        part.direction /= length;
        all.push_back(part);
        return;
    }
    // As long as it is on the sphere.
    const double middle = (0.5 * (area.bottom + area.top) / rows_ - 0.5) * glm::pi<double>();
    const bool isWide =
        height == 1 || (width > 1 && width * std::cos(middle) * rows_ * 2 > height * columns_);
    const int first = count / 2;
    const double wanted = weightOf(area) * first / count;
    const int begin = isWide ? area.left : area.bottom;
    const int end = isWide ? area.right : area.top;
    int split = begin;
    for (double sum = 0.0; split + 2 <= end && (split == begin || sum < wanted); ++split) {
        sum += weightOf(isWide ? Area{split, split + 1, area.bottom, area.top}
                               : Area{area.left, area.right, split, split + 1});
    }
    Area one = area;
    Area other = area;
    (isWide ? one.right : one.top) = split;
    (isWide ? other.left : other.bottom) = split;
    addParts(one, first, all);
    addParts(other, count - first, all);
}

std::vector<EmittingEnvironment::Part> EmittingEnvironment::parts(int count) const {
    std::vector<Part> all;
    addParts({0, columns_, 0, rows_}, count, all);
    return all;
}

EmittingEnvironment::Part EmittingEnvironment::draw(double which, double u, double v) const {
    if (!(cumulated_.back() > 0.0)) return {};
    const auto found =
        std::upper_bound(cumulated_.begin(), cumulated_.end(), which * cumulated_.back());
    const auto index =
        std::min(static_cast<std::size_t>(found - cumulated_.begin()), cumulated_.size() - 1);
    const auto columns = static_cast<std::size_t>(columns_);
    const auto row = static_cast<double>(index / columns);
    const auto column = static_cast<double>(index % columns);
    // Evenly over the cell's solid angle.
    const auto sineAt = [&](double edge) {
        return std::sin(glm::pi<double>() * (edge / rows_ - 0.5));
    };
    const double sine = glm::mix(sineAt(row), sineAt(row + 1.0), v);
    const double latitude = std::asin(std::clamp(sine, -1.0, 1.0));
    const glm::dvec3 direction =
        directionOf(column + u, (latitude / glm::pi<double>() + 0.5) * rows_);
    const glm::dvec3& flux = fluxes_[index];
    return {direction, flux * (cumulated_.back() / total(flux))};
}

}  // namespace kaustik::scene
