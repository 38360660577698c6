// SPDX-License-Identifier: MIT
#include "framework/judge/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/judge/fitting.h"
#include "framework/judge/primaries.h"
#include "framework/judge/sentences.h"

namespace kaustik::judge {
namespace {

// A spread of the channels' exposures below this is not spoken of, nor one that chance makes: a
// colour matrix of four digits, or a spectrum as channels, makes as much.
constexpr double kMinChannelSpread = 0.02;  // of their mean
// The two encodings fit alike where what they leave differs by less than this factor.
constexpr double kEqualEncoding = 1.15;
// Of a scale that was rounded only floating point's error is left.
constexpr double kMinZoom = 1e-9;

void addOrientation(const Registration& registration, std::vector<Finding>& findings) {
    if (registration.isFlippedX && registration.isFlippedY) {
        findings.push_back({"turned", 1.0, 0.0, "the picture is turned by 180 degrees", {}});
    } else if (registration.isFlippedX) {
        findings.push_back(
            {"flipped-x",
             1.0,
             0.0,
             "the picture is mirrored left to right, as by a camera of the other handedness",
             {}});
    } else if (registration.isFlippedY) {
        findings.push_back(
            {"flipped-y", 1.0, 0.0, "the picture is upside down: its first row is the lowest", {}});
    }
}

void addFieldOfView(const Comparison& comparison, double zoom, const Evidence& evidence,
                    std::vector<Finding>& findings) {
    const double fov = fieldOfViewOf(comparison, zoom);
    const double error = std::abs(fieldOfViewOf(comparison, zoom + evidence.placementError.scale) -
                                  fieldOfViewOf(comparison, zoom - evidence.placementError.scale)) /
                         2.0;
    findings.push_back(
        {"field-of-view",
         fov,
         error,
         fmt::format("the vertical field of view is {:.2f} ± {:.2g} degrees instead of "
                     "{:.2f}{}",
                     fov, error, comparison.subject.verticalFovDegrees,
                     aspectHint(comparison, zoom)),
         {}});
}

void addShift(const Registration& registration, const PlacementError& errors,
              std::vector<Finding>& findings) {
    const glm::dvec2 shift = registration.shift;
    const glm::dvec2 error = errors.shiftPixels;
    const auto isHalf = [](double value) {
        return value == 0.0 || std::abs(std::abs(value) - 0.5) < 1e-9;
    };
    findings.push_back(
        {"shift",
         glm::length(shift),
         glm::length(error),
         fmt::format("the picture is moved by ({:+.2f}, {:+.2f}) ± ({:.2g}, {:.2g}) pixels "
                     "to the right and down{}",
                     shift.x, shift.y, error.x, error.y,
                     isHalf(shift.x) && isHalf(shift.y)
                         ? ", half a pixel: its rays go through the corners of pixels"
                         : ""),
         {}});
}

void addRegistration(const Comparison& comparison, const Evidence& evidence,
                     std::vector<Finding>& findings) {
    const Registration& registration = comparison.registration;
    addOrientation(registration, findings);
    const Image& ours = comparison.columns.front().image;
    const double usual = usualScale(comparison);
    const bool isSameSize =
        comparison.theirs.width == ours.width && comparison.theirs.height == ours.height;
    const double zoom = registration.scale / usual;
    if (!isSameSize && registration.scale == 1.0) {
        const glm::dvec2 corner = 0.5 * glm::dvec2(ours.width - comparison.theirs.width,
                                                   ours.height - comparison.theirs.height) -
                                  registration.shift;
        findings.push_back(
            {"crop",
             1.0,
             0.0,
             fmt::format("the picture is a part of {}x{} pixels, its corner at ({:.1f}, {:.1f})",
                         comparison.theirs.width, comparison.theirs.height, corner.x, corner.y),
             {}});
        return;
    }
    if (!isSameSize && zoom == 1.0)
        findings.push_back(
            {"size",
             registration.scale,
             0.0,
             fmt::format("the picture has {}x{} pixels where the reference has {}x{}",
                         comparison.theirs.width, comparison.theirs.height, ours.width,
                         ours.height),
             {}});
    if (std::abs(zoom - 1.0) > kMinZoom) addFieldOfView(comparison, zoom, evidence, findings);
    if (registration.shift != glm::dvec2(0.0))
        addShift(registration, evidence.placementError, findings);
}

void addEncoding(const Comparison& comparison, const Evidence& evidence,
                 std::vector<Finding>& findings) {
    if (comparison.encoding == Encoding::linear) return;
    std::vector<std::string> also;
    if (evidence.encodingScores.size() == 3 &&
        std::max(evidence.encodingScores[1], evidence.encodingScores[2]) <
            kEqualEncoding * std::min(evidence.encodingScores[1], evidence.encodingScores[2])) {
        also.emplace_back(comparison.encoding == Encoding::srgb ? "a power of 1/2.2"
                                                                : "the sRGB curve");
    }
    findings.push_back(
        {"encoding", 0.0, 0.0,
         fmt::format("its values are not linear light: they are coded by {}",
                     comparison.encoding == Encoding::srgb ? "the sRGB curve" : "a power of 1/2.2"),
         also});
}

// What was asked for is no finding.
void addPrimaries(const Comparison& comparison, const Evidence& evidence,
                  std::vector<Finding>& findings) {
    if (comparison.options.primaries != Primaries::automatic ||
        comparison.primaries == Primaries::rec709)
        return;
    const auto sentence = [](Primaries primaries) {
        return fmt::format("the picture is in {} primaries", titleOf(primaries));
    };
    std::vector<std::string> also;
    for (const Primaries other : evidence.otherPrimaries)
        also.push_back(sentence(other));
    findings.push_back({"primaries", 0.0, 0.0, sentence(comparison.primaries), also});
}

// A factor of each channel for what is fitted to all of them together.
void addChannels(const Comparison& comparison, const Evidence& evidence,
                 std::vector<Finding>& findings) {
    const Image prediction = predictionOf(comparison, evidence.solution.fitted);
    glm::dvec3 products(0.0);
    glm::dvec3 squares(0.0);
    for (std::size_t i = 0; i < comparison.weight.values.size(); ++i) {
        const auto weight = static_cast<double>(comparison.weight.values[i]);
        const auto light = static_cast<double>(prediction.values[i]);
        const auto channel = static_cast<glm::length_t>(i % 3);
        products[channel] += weight * light * static_cast<double>(comparison.picture.values[i]);
        squares[channel] += weight * light * light;
    }
    const glm::dvec3 factors = products / glm::max(squares, glm::dvec3(1e-300));
    const double mean = (factors.r + factors.g + factors.b) / 3.0;
    const double spread =
        std::max({factors.r, factors.g, factors.b}) - std::min({factors.r, factors.g, factors.b});
    const double error =
        1.0 / std::sqrt(std::max(std::min({squares.r, squares.g, squares.b}), 1e-300));
    if (!(spread > std::max(kMinChannelSpread * mean, kSignificantErrors * error))) return;
    findings.push_back(
        {"channels",
         spread / mean,
         error / mean,
         fmt::format("its channels have other exposures, red {:.3f}, green {:.3f} and blue "
                     "{:.3f} of the mean: a white balance, a light's colour or other primaries",
                     factors.r / mean, factors.g / mean, factors.b / mean),
         {}});
}

void addBlur(const Comparison& comparison, std::vector<Finding>& findings) {
    if (!(comparison.blurPixels > 0.0)) return;
    findings.push_back(
        {"blur",
         comparison.blurPixels,
         0.0,
         fmt::format("its caustics are blurred by {:.2g} pixels (standard deviation), as by "
                     "a filter or the kernel of a photon map",
                     comparison.blurPixels),
         {}});
}

void addCauses(const Comparison& comparison, const Evidence& evidence,
               std::vector<Finding>& findings) {
    for (const Choice& choice : evidence.choices) {
        const Role role = choice.candidate.role;
        if (role == Role::lightClass || role == Role::allClasses) continue;
        std::vector<double> amounts;
        std::vector<double> errors;
        const Candidate& candidate = choice.candidate;
        double amount = 0.0;
        double variance = 0.0;
        for (std::size_t i = 0; i < candidate.columns.size(); ++i) {
            const std::size_t place = placeOf(evidence.solution.fitted, candidate.columns[i]);
            amounts.push_back(evidence.solution.fitted.values[place] / evidence.exposure.ofPicture);
            errors.push_back(
                std::sqrt(std::max(evidence.solution.covariance.at(place, place), 0.0)) /
                evidence.exposure.ofPicture);
            amount += candidate.steps[i] * amounts.back();
            for (std::size_t j = 0; j < candidate.columns.size(); ++j) {
                variance += candidate.steps[i] * candidate.steps[j] *
                            evidence.solution.covariance.at(
                                place, placeOf(evidence.solution.fitted, candidate.columns[j]));
            }
        }
        if (role == Role::cause) {
            amounts = {amount};
            errors = {std::sqrt(std::max(variance, 0.0)) / evidence.exposure.ofPicture};
        }
        const std::string name = role == Role::cause
                                     ? comparison.subject.causes[choice.candidate.index].name
                                 : role == Role::shiftX ? "shift"
                                 : role == Role::scale  ? "field-of-view"
                                                        : "fill";
        findings.push_back({name, amounts.front(), errors.front(),
                            sentenceOf(comparison, choice.candidate, amounts, errors),
                            choice.also});
    }
}

}  // namespace

std::vector<Finding> findingsOf(const Comparison& comparison, const Evidence& evidence) {
    std::vector<Finding> findings;
    addRegistration(comparison, evidence, findings);
    addEncoding(comparison, evidence, findings);
    addPrimaries(comparison, evidence, findings);
    addChannels(comparison, evidence, findings);
    addBlur(comparison, findings);
    addCauses(comparison, evidence, findings);
    addClasses(comparison, evidence, findings);
    return findings;
}

}  // namespace kaustik::judge
