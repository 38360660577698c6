// SPDX-License-Identifier: MIT
#include "framework/judge/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/core/error.h"
#include "framework/judge/alignment.h"
#include "framework/judge/fitting.h"
#include "framework/judge/pictures.h"
#include "framework/judge/weights.h"

namespace kaustik::judge {
namespace {

// A picture that varies no more than this many times its noise shows nothing to tell a scene by.
constexpr double kMinContrast = 3.0;
// What explains less of a picture is no description of it. Of right pictures, and of those with a
// planted mistake, 0.96 at least is explained, of another camera's or another scene's 0.74 at most
// where no homography is found (tests/judging, and pictures by POV-Ray).
constexpr double kMinExplained = 0.85;
// Where less than this is left there is no room for another camera.
constexpr double kMinUnexplained = 0.005;
// By another camera the light alone must leave less than this share of what all mistakes together
// leave: a mistake in the light moves a part of it, and by the lights' own rules.
constexpr double kMaxLossOfCamera = 0.75;
// Less than half a pixel may be how pixels are filtered.
constexpr double kMinWarpPixels = 0.5;
constexpr int kMaxRounds = 12;
constexpr double kMaxStepPixels = 2.0;  // of a derivative's reach
constexpr double kMinStepPixels = 0.02;

// A plane that another camera sees is moved by a homography; near none it is a sum of eight. Places
// are from the picture's middle, in halves of its height. The first three are what registration
// finds by itself: shifts and a scale.
constexpr std::size_t kWarps = 8;
constexpr std::size_t kFirstOfCamera = 3;
constexpr std::size_t kRoll = 3;

glm::dvec2 movedBy(std::size_t warp, const glm::dvec2& u) {
    switch (warp) {
        case 0:
            return {1.0, 0.0};
        case 1:
            return {0.0, 1.0};
        case 2:
            return u;
        case kRoll:
            return {-u.y, u.x};
        case 4:
            return {u.x, -u.y};
        case 5:
            return {u.y, u.x};
        case 6:
            return u.x * u;
        default:
            return u.y * u;
    }
}

using Amounts = std::array<double, kWarps>;

// What takes such a move back, to first order. Columns first, as GLM has them.
glm::dmat3 inverseOf(const Amounts& a) {
    return {{1.0 - a[2] - a[4], -a[3] - a[5], a[6]},
            {a[3] - a[5], 1.0 - a[2] + a[4], a[7]},
            {-a[0], -a[1], 1.0}};
}

// The farthest that a corner of the picture is moved by the warps from `first` on, in pixels.
double cornerPixels(const Image& picture, const Amounts& amounts, std::size_t first) {
    const double unit = 0.5 * picture.height;
    double farthest = 0.0;
    for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
            const glm::dvec2 corner = glm::dvec2(x * picture.width, y * picture.height) / unit;
            glm::dvec2 moved(0.0);
            for (std::size_t k = first; k < kWarps; ++k)
                moved += amounts[k] * movedBy(k, corner);
            farthest = std::max(farthest, unit * glm::length(moved));
        }
    }
    return farthest;
}

double huberLoss(double off) {
    return off < kFarOff ? 0.5 * off * off : kFarOff * (off - 0.5 * kFarOff);
}

// The mean loss of the best mixture of some columns, with Huber's weights by light; and the fit.
double lossOf(Comparison& comparison, const std::vector<std::size_t>& columns, LinearFit& fitted) {
    weighByLight(comparison);
    comparison.plainWeight = comparison.weight;
    double loss = 0.0;
    for (int round = 0; round < 3; ++round) {
        makeEquations(comparison);
        fitted = fit(comparison, columns);
        loss = reweighFarOff(comparison, fitted);
    }
    return loss;
}

// What noise alone would leave.
double lossOfNoise(const Comparison& comparison) {
    double loss = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < comparison.deviation.values.size(); ++i) {
        const auto weight = static_cast<double>(comparison.plainWeight.values[i]);
        if (!(weight > 0.0)) continue;
        loss += huberLoss(static_cast<double>(comparison.deviation.values[i]) * std::sqrt(weight));
        count += 1.0;
    }
    return loss / std::max(count, 1.0);
}

std::vector<std::size_t> lightColumns(const Comparison& comparison) {
    return columnsOf(comparison, {Role::direct, Role::lightClass, Role::fill});
}
std::vector<std::size_t> allColumns(const Comparison& comparison) {
    return columnsOf(comparison, {Role::direct, Role::lightClass, Role::cause, Role::fill});
}

// Another camera, as far as steps of Gauss and Newton lead to one.
struct OtherCamera {
    Amounts amounts{};  // summed over the steps
    Amounts errors{};   // standard errors, of the last step
    bool isFound = false;
};

// The derivatives of what is fitted, by each warp.
void addWarps(Comparison& comparison, const Image& prediction) {
    const Image dx = derivativeX(prediction);
    const Image dy = derivativeY(prediction);
    const double unit = 0.5 * prediction.height;
    for (std::size_t k = 0; k < kWarps; ++k) {
        Image image(prediction.width, prediction.height, 3);
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const glm::dvec2 place =
                    glm::dvec2(x + 0.5 - 0.5 * image.width, y + 0.5 - 0.5 * image.height) / unit;
                const glm::dvec2 moved = unit * movedBy(k, place);
                for (int c = 0; c < 3; ++c) {
                    image.at(x, y, c) =
                        static_cast<float>(moved.x * static_cast<double>(dx.at(x, y, c)) +
                                           moved.y * static_cast<double>(dy.at(x, y, c)));
                }
            }
        }
        comparison.columns.push_back({Role::warp, k, std::move(image), {}});
    }
}

// Moves the registration; false where it leads nowhere.
bool step(Comparison& comparison, OtherCamera& camera, double& reach) {
    const std::size_t plain = comparison.columns.size();
    LinearFit fitted;
    static_cast<void>(lossOf(comparison, lightColumns(comparison), fitted));
    addWarps(comparison, predictionOf(comparison, fitted));
    std::vector<std::size_t> columns = lightColumns(comparison);
    for (std::size_t k = 0; k < kWarps; ++k)
        columns.push_back(plain + k);
    makeEquations(comparison);
    fitted = fit(comparison, columns);
    const bool isSolved = fitted.isSolved();
    Amounts amounts{};
    if (isSolved) {
        const Symmetric covariance = covarianceOf(comparison, fitted);
        for (std::size_t k = 0; k < kWarps; ++k) {
            const std::size_t place = placeOf(fitted, plain + k);
            amounts[k] = fitted.values[place];
            camera.errors[k] = std::sqrt(std::max(covariance.at(place, place), 0.0));
        }
    }
    comparison.columns.resize(plain);
    if (!isSolved) return false;
    reach = cornerPixels(comparison.picture, amounts, 0);
    const double share = std::min(1.0, kMaxStepPixels / std::max(reach, 1e-9));
    for (std::size_t k = 0; k < kWarps; ++k) {
        amounts[k] *= share;
        camera.amounts[k] += amounts[k];
    }
    comparison.registration.warp = comparison.registration.warp * inverseOf(amounts);
    align(comparison);
    return pixelCount(comparison.counted) > 0.0;
}

OtherCamera findCamera(Comparison& comparison) {
    OtherCamera camera;
    makeColumns(comparison, false);
    double reach = 0.0;
    for (int round = 0; round < kMaxRounds; ++round) {
        if (!step(comparison, camera, reach)) return camera;
        if (reach < kMinStepPixels) break;
    }
    for (std::size_t k = kFirstOfCamera; k < kWarps; ++k) {
        camera.isFound =
            camera.isFound || std::abs(camera.amounts[k]) > kSignificantErrors * camera.errors[k];
    }
    return camera;
}

// The share of the picture's variation that is explained, by the losses of the even light, of all
// that is known, and of noise.
double explainedShare(double even, double all, double noise) {
    return 1.0 - std::max(all - noise, 0.0) / std::max(even - noise, 1e-300);
}

std::string howItMoves(const Image& picture, const OtherCamera& camera) {
    Amounts others = camera.amounts;
    others[kRoll] = 0.0;
    const double degrees = glm::degrees(camera.amounts[kRoll]);
    const bool isRolled = cornerPixels(picture, others, kFirstOfCamera) <
                          0.5 * cornerPixels(picture, camera.amounts, kFirstOfCamera);
    return isRolled ? fmt::format("turned by about {:.1f} degrees about the line of sight",
                                  std::abs(degrees))
                    : fmt::format(
                          "its corners lie {:.1f} pixels from where a shift and a scale put "
                          "them",
                          cornerPixels(picture, camera.amounts, kFirstOfCamera));
}

}  // namespace

std::optional<double> requireSameView(Comparison& comparison) {
    const Registration before = comparison.registration;
    LinearFit fitted;
    // Least squares of fewer columns may lose less by Huber's measure.
    const double light = lossOf(comparison, lightColumns(comparison), fitted);
    const double all = std::min(light, lossOf(comparison, allColumns(comparison), fitted));
    const double noise = lossOfNoise(comparison);
    const double even = lossOf(comparison, columnsOf(comparison, {Role::fill}), fitted);
    if (even < kMinContrast * noise) return std::nullopt;
    const double explained = explainedShare(even, all, noise);
    if (1.0 - explained < kMinUnexplained) return explained;
    const OtherCamera camera = findCamera(comparison);
    const double moved = cornerPixels(comparison.picture, camera.amounts, kFirstOfCamera);
    if (camera.isFound && moved > kMinWarpPixels) {
        const double otherwise =
            explainedShare(even, lossOf(comparison, lightColumns(comparison), fitted), noise);
        if (otherwise > kMinExplained && 1.0 - otherwise < kMaxLossOfCamera * (1.0 - explained)) {
            throw ConfigError(fmt::format(
                "{} does not show {} by its camera: {}, as from another place or in another "
                "direction, or with its lights elsewhere (so {:.1f} % of what varies in it is "
                "explained, and as the scene is {:.1f} %).",
                comparison.subject.theirsName, comparison.subject.scene,
                howItMoves(comparison.picture, camera), 100.0 * otherwise, 100.0 * explained));
        }
    }
    makeColumns(comparison, true);
    comparison.registration = before;
    align(comparison);
    if (explained < kMinExplained) {
        throw ConfigError(
            fmt::format("{} does not show {} by its camera: no mixture of the scene's light and of "
                        "known mistakes explains more than {:.0f} % of what varies in it.",
                        comparison.subject.theirsName, comparison.subject.scene,
                        100.0 * std::max(explained, 0.0)));
    }
    return explained;
}

}  // namespace kaustik::judge
