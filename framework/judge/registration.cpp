// SPDX-License-Identifier: MIT
#include "framework/judge/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace kaustik::judge {
namespace {

constexpr int kCoarseWidth = 48;
constexpr double kScaleStep = 1.05;
constexpr int kScaleSteps = 14;  // to each side: to a half and to twice
constexpr std::size_t kFinalists = 12;
// By how much another way up, scale or place must be better to be believed.
constexpr double kMuchBetter = 0.02;

// One channel, the square root of the mean over channels: as far as a gamma goes, whatever it is.
Image rootOf(const Image& image) {
    Image result(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            float sum = 0.0f;
            for (int c = 0; c < image.channels; ++c)
                sum += std::max(image.at(x, y, c), 0.0f);
            result.at(x, y, 0) = std::sqrt(sum / static_cast<float>(image.channels));
        }
    }
    return result;
}

// The mean over a rectangle of pixels, of those whose middles are in it.
float meanOf(const Image& image, double left, double top, double right, double bottom) {
    const int x0 = std::clamp(static_cast<int>(std::ceil(left - 0.5)), 0, image.width - 1);
    const int y0 = std::clamp(static_cast<int>(std::ceil(top - 0.5)), 0, image.height - 1);
    const int x1 = std::clamp(static_cast<int>(std::ceil(right - 0.5)) - 1, x0, image.width - 1);
    const int y1 = std::clamp(static_cast<int>(std::ceil(bottom - 0.5)) - 1, y0, image.height - 1);
    double sum = 0.0;
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x)
            sum += static_cast<double>(image.at(x, y, 0));
    }
    return static_cast<float>(sum / ((x1 - x0 + 1.0) * (y1 - y0 + 1.0)));
}

// A picture on a coarse grid, of cells of so many of its pixels, around its middle; NaN outside.
std::vector<float> coarse(const Image& image, int width, int height, double cell) {
    std::vector<float> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double left = 0.5 * image.width + (x - 0.5 * width) * cell;
            const double top = 0.5 * image.height + (y - 0.5 * height) * cell;
            const bool isInside = left > -0.5 * cell && top > -0.5 * cell &&
                                  left + cell < image.width + 0.5 * cell &&
                                  top + cell < image.height + 0.5 * cell;
            values[static_cast<std::size_t>(y * width + x)] =
                isInside ? meanOf(image, left, top, left + cell, top + cell) : NAN;
        }
    }
    return values;
}

struct Grid {
    int width = 0;
    int height = 0;
    double cell = 1.0;  // of the reference's pixels
    std::vector<float> model;
    std::vector<float> mask;
};

struct Placement {
    std::size_t way = 0;  // 1: left to right, 2: upside down
    double scale = 1.0;
    int dx = 0;  // cells
    int dy = 0;
    double correlation = -1.0;
};

double correlationOf(const Grid& grid, const std::vector<float>& theirs, int dx, int dy) {
    double n = 0.0;
    double a = 0.0;
    double b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (int y = 0; y < grid.height; ++y) {
        const int other = y + dy;
        if (other < 0 || other >= grid.height) continue;
        for (int x = std::max(0, -dx); x < std::min(grid.width, grid.width - dx); ++x) {
            const auto at = static_cast<std::size_t>(y * grid.width + x);
            const auto value =
                static_cast<double>(theirs[static_cast<std::size_t>(other * grid.width + x + dx)]);
            if (grid.mask[at] < 0.5f || std::isnan(value)) continue;
            const auto own = static_cast<double>(grid.model[at]);
            n += 1.0;
            a += own;
            b += value;
            aa += own * own;
            bb += value * value;
            ab += own * value;
        }
    }
    // What hardly overlaps fits by chance.
    if (n < 0.3 * static_cast<double>(grid.model.size())) return -1.0;
    const double variance = (aa - a * a / n) * (bb - b * b / n);
    return variance > 0.0 ? (ab - a * b / n) / std::sqrt(variance) : 0.0;
}

// The best place so many cells around one.
Placement bestPlacement(const Grid& grid, const Image& turned, const Placement& around, int reachX,
                        int reachY) {
    const std::vector<float> values =
        coarse(turned, grid.width, grid.height, grid.cell * around.scale);
    Placement best = around;
    for (int dy = around.dy - reachY; dy <= around.dy + reachY; ++dy) {
        for (int dx = around.dx - reachX; dx <= around.dx + reachX; ++dx) {
            const double correlation = correlationOf(grid, values, dx, dy);
            if (correlation > best.correlation)
                best = {around.way, around.scale, dx, dy, correlation};
        }
    }
    return best;
}

double cubic(double distance) {
    const double x = std::abs(distance);
    if (x < 1.0) return 1.5 * x * x * x - 2.5 * x * x + 1.0;
    if (x < 2.0) return -0.5 * x * x * x + 2.5 * x * x - 4.0 * x + 2.0;
    return 0.0;
}

float cubicAt(const Image& image, const glm::dvec2& place, int channel) {
    // Beyond its edges the picture is as it is there.
    const double x = std::clamp(place.x, -2.0, image.width + 2.0) - 0.5;
    const double y = std::clamp(place.y, -2.0, image.height + 2.0) - 0.5;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    double sum = 0.0;
    for (int j = -1; j <= 2; ++j) {
        for (int i = -1; i <= 2; ++i) {
            const double weight = cubic(x - (column + i)) * cubic(y - (row + j));
            if (weight == 0.0) continue;
            sum += weight *
                   static_cast<double>(image.at(std::clamp(column + i, 0, image.width - 1),
                                                std::clamp(row + j, 0, image.height - 1), channel));
        }
    }
    return static_cast<float>(sum);
}

// The picture at places before its own, along one axis.
Image movedAlong(const Image& image, double by, bool isAlongX) {
    if (by == 0.0) return image;
    const int whole = static_cast<int>(std::floor(-by));
    const double rest = -by - whole;
    Image result(image.width, image.height, image.channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                double sum = 0.0;
                for (int i = -1; i <= 2; ++i) {
                    const int column = isAlongX ? x + whole + i : x;
                    const int row = isAlongX ? y : y + whole + i;
                    sum += cubic(rest - i) *
                           static_cast<double>(image.at(std::clamp(column, 0, image.width - 1),
                                                        std::clamp(row, 0, image.height - 1), c));
                }
                result.at(x, y, c) = static_cast<float>(sum);
            }
        }
    }
    return result;
}

}  // namespace

Image movedBy(const Image& image, const glm::dvec2& by) {
    return movedAlong(movedAlong(image, by.x, true), by.y, false);
}

glm::dvec2 Registration::placeOf(const glm::dvec2& pixel, const Image& reference,
                                 const Image& theirs) const {
    glm::dvec2 fromMiddle = pixel - 0.5 * glm::dvec2(reference.width, reference.height);
    if (warp != glm::dmat3(1.0)) {
        const double unit = 0.5 * reference.height;
        const glm::dvec3 warped = warp * glm::dvec3(fromMiddle / unit, 1.0);
        // Behind the other camera there is no picture.
        if (!(warped.z > 0.0)) return glm::dvec2(-HUGE_VAL);
        fromMiddle = unit * glm::dvec2(warped) / warped.z;
    }
    return 0.5 * glm::dvec2(theirs.width, theirs.height) + scale * fromMiddle + shift;
}

Image flipped(const Image& image, bool isFlippedX, bool isFlippedY) {
    if (!isFlippedX && !isFlippedY) return image;
    Image result(image.width, image.height, image.channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                result.at(x, y, c) = image.at(isFlippedX ? image.width - 1 - x : x,
                                              isFlippedY ? image.height - 1 - y : y, c);
            }
        }
    }
    return result;
}

Registration findRegistration(const Image& theirs, const Image& model, const Image& mask) {
    const Image modelRoot = rootOf(model);
    const auto gridOf = [&](int width) {
        const double cell = static_cast<double>(model.width) / width;
        Grid grid{width, std::max(1, static_cast<int>(model.height / cell)), cell, {}, {}};
        grid.model = coarse(modelRoot, grid.width, grid.height, cell);
        grid.mask = coarse(mask, grid.width, grid.height, cell);
        return grid;
    };
    const Grid grid = gridOf(std::min(kCoarseWidth, model.width));
    const Grid coarsest = gridOf(std::min(kCoarseWidth / 2, model.width));
    const double usual = static_cast<double>(theirs.height) / model.height;
    const Image root = rootOf(theirs);
    const std::array<Image, 4> turned = {root, flipped(root, true, false),
                                         flipped(root, false, true), flipped(root, true, true)};
    Registration plain;
    plain.scale = usual;
    plain.correlation =
        correlationOf(grid, coarse(root, grid.width, grid.height, grid.cell * usual), 0, 0);
    // Pictures of other sizes may be crops, with pixels as large as ours.
    std::vector<double> scales = {1.0};
    for (int step = -kScaleSteps; step <= kScaleSteps; ++step)
        scales.push_back(usual * std::pow(kScaleStep, step));
    std::vector<Placement> placements;
    for (std::size_t way = 0; way < turned.size(); ++way) {
        for (const double scale : scales) {
            placements.push_back(bestPlacement(coarsest, turned[way], {way, scale, 0, 0, -1.0},
                                               coarsest.width / 4, coarsest.height / 4));
        }
    }
    std::sort(placements.begin(), placements.end(),
              [](const Placement& a, const Placement& b) { return a.correlation > b.correlation; });
    placements.resize(std::min<std::size_t>(placements.size(), kFinalists));
    Registration found = plain;
    for (const Placement& finalist : placements) {
        const double finer = coarsest.cell / grid.cell;
        const Placement place = bestPlacement(
            grid, turned[finalist.way],
            {finalist.way, finalist.scale, static_cast<int>(std::lround(finalist.dx * finer)),
             static_cast<int>(std::lround(finalist.dy * finer)), -1.0},
            2, 2);
        if (place.correlation <= found.correlation) continue;
        found = {(place.way & 1u) != 0, (place.way & 2u) != 0, place.scale,
                 glm::dvec2(place.dx, place.dy) * grid.cell * place.scale, place.correlation};
    }
    const double needed =
        plain.correlation + kMuchBetter * (1.0 - std::max(plain.correlation, 0.0)) + 0.005;
    return found.correlation > needed ? found : plain;
}

Image resampled(const Image& theirs, const Registration& registration, const Image& reference,
                Image& mask) {
    const Image turned = flipped(theirs, registration.isFlippedX, registration.isFlippedY);
    Image result(reference.width, reference.height, theirs.channels);
    // Where their pixels are smaller, several lie in one of ours.
    const int side = std::max(1, static_cast<int>(std::lround(registration.scale)));
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            const glm::dvec2 middle =
                registration.placeOf(glm::dvec2(x + 0.5, y + 0.5), reference, turned);
            const double half = 0.5 * std::max(registration.scale, 1.0);
            if (middle.x < half - 1e-6 || middle.y < half - 1e-6 ||
                middle.x > turned.width - half + 1e-6 || middle.y > turned.height - half + 1e-6)
                mask.at(x, y, 0) = 0.0f;
            for (int c = 0; c < theirs.channels; ++c) {
                float sum = 0.0f;
                for (int i = 0; i < side * side; ++i) {
                    const glm::dvec2 part(x + (i % side + 0.5) / side, y + (i / side + 0.5) / side);
                    sum += cubicAt(turned, registration.placeOf(part, reference, turned), c);
                }
                result.at(x, y, c) = sum / static_cast<float>(side * side);
            }
        }
    }
    return result;
}

}  // namespace kaustik::judge
