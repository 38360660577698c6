// SPDX-License-Identifier: MIT
#include "framework/judge/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/core/error.h"
#include "framework/judge/linear_fit.h"
#include "framework/judge/pictures.h"

namespace kaustik::judge {
namespace {

// Below this the two pictures have nothing in common.
constexpr double kLeastCorrelation = 0.4;
// Without direct light they must be as like as this, or it is thought to be there.
constexpr double kSureCorrelation = 0.7;
// What no picture is better than: interpolation, 16-bit floats, the edges of triangles.
constexpr double kFloorOfLight = 0.003;  // of the light in a pixel
constexpr double kFloorOfMean = 0.001;   // of the mean of all
// Coefficients of classes that are nearer to 1 are right.
constexpr double kRightWithin = 0.05;
constexpr double kLeastShare = 5e-4;  // of the caustic, for a class of its own
constexpr double kSignificant = 4.0;  // standard errors
// A cause must explain this share of what is unexplained, to be believed.
constexpr double kLeastGain = 0.03;
// One that explains this share of what the best one does explains it as well.
constexpr double kAsWell = 0.9;
// A place is another one where this much of the loss is left there.
constexpr double kBetterPlace = 0.85;
constexpr double kLeastShift = 0.05;    // pixels
constexpr double kLeastScale = 0.0015;  // relative
constexpr double kLeastColor = 0.02;    // between channels
constexpr double kLeastBlur = 0.35;     // pixels
constexpr double kFalseAlarms = 0.01;   // chance that any pixel of a right picture is significant
constexpr double kPi = 3.14159265358979323846;

// The z that a normal variate exceeds on either side with this chance (Beasley, Springer and
// Moro's approximation would do; bisection of erfc is exact).
double criticalZ(double chance) {
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > chance ? low : high) = middle;
    }
    return high;
}

enum class Role { total, direct, lightClass, allClasses, cause, shiftX, shiftY, scale, fill };

struct Column {
    Role role = Role::total;
    std::size_t index = 0;  // of a class or a cause
    Image image;
    Image error;  // empty: none
};

// A set of columns that stands or falls together.
struct Candidate {
    std::vector<std::size_t> columns;
    Role role = Role::cause;
    std::size_t index = 0;      // of a class, or of the first of its causes
    std::vector<double> steps;  // of causes: the amounts that their columns are of
};

bool isEmpty(const Image& image) {
    return image.values.empty();
}

double total(const Image& image, const Image& mask) {
    double result = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels && mask.at(x, y, 0) > 0.5f; ++c)
                result += static_cast<double>(image.at(x, y, c));
        }
    }
    return result;
}

class Judgement {
  public:
    Judgement(Subject subject, const JudgeOptions& options)
        : subject_(std::move(subject)), options_(options), theirs_(threeChannels(subject_.theirs)) {
        verdict_.scene = subject_.scene;
        verdict_.theirs = subject_.theirsName;
    }

    Verdict run() {
        requireNumbers();
        requireCaustic(subject_.mask);
        joinFaintClasses();
        clear_ = subject_.mask;
        for (std::size_t i = 0; i < clear_.values.size(); ++i) {
            if (subject_.hasGlass.values[i] > 0.5f) clear_.values[i] = 0.0f;
        }
        hasDirect_ = options_.direct != DirectLight::without && !isEmpty(subject_.direct);
        counted_ = options_.glass == Glass::seen ? clear_ : subject_.mask;
        verdict_.glassIsHidden = options_.glass == Glass::hidden;
        registerPictures();
        if (options_.glass == Glass::automatic) decideGlass();
        requireCaustic(counted_);
        decideDirect();
        refine();
        weigh();
        decideBlur();
        weigh();
        selectCauses();
        finish();
        return std::move(verdict_);
    }

  private:
    // ---- What cannot be judged ----

    void requireNumbers() const {
        double most = 0.0;
        double mean = 0.0;
        for (const float value : theirs_.values) {
            if (!std::isfinite(value)) {
                throw ConfigError(
                    fmt::format("{} holds values that are no numbers; it cannot be judged.",
                                subject_.theirsName));
            }
            most = std::max(most, static_cast<double>(value));
            mean += static_cast<double>(value) / static_cast<double>(theirs_.values.size());
        }
        // Filters with negative lobes and noise go a little below 0.
        const auto negative = static_cast<std::size_t>(std::count_if(
            theirs_.values.begin(), theirs_.values.end(),
            [&](float value) { return static_cast<double>(value) < -0.05 * std::abs(mean); }));
        if (!(most > 0.0))
            throw ConfigError(
                fmt::format("{} is black; there is nothing to judge.", subject_.theirsName));
        if (negative > theirs_.values.size() / 20) {
            throw ConfigError(
                fmt::format("{} is negative in {:.0f} % of its values, which no "
                            "light is.",
                            subject_.theirsName,
                            100.0 * static_cast<double>(negative) /
                                static_cast<double>(theirs_.values.size())));
        }
    }

    void requireCaustic(const Image& mask) const {
        double whole = 0.0;
        double inMask = 0.0;
        for (const Light& light : subject_.classes) {
            whole += total(light.radiance, Image(subject_.mask));
            inMask += total(light.radiance, mask);
        }
        if (!(whole > 0.0)) {
            throw ConfigError(
                fmt::format("In this view of {} there is no caustic to judge by.", subject_.scene));
        }
        if (inMask < 0.02 * whole) {
            throw ConfigError(fmt::format(
                "The eye sees the caustics of {} through glass or water, which {} seems to show; "
                "render them without (--glass hidden says that it was).",
                subject_.scene, subject_.theirsName));
        }
    }

    // What is next to nothing in the picture cannot be told apart in it.
    void joinFaintClasses() {
        double light = 0.0;
        for (const Light& of : subject_.classes)
            light += total(of.radiance, subject_.mask);
        std::vector<Light> kept;
        std::optional<Light> rest;
        for (Light& of : subject_.classes) {
            const bool isFaint = total(of.radiance, subject_.mask) < kLeastShare * light;
            if (!isFaint && of.name != "other") {
                kept.push_back(std::move(of));
            } else if (!rest) {
                rest = std::move(of);
                rest->name = "other";
            } else {
                for (std::size_t i = 0; i < rest->radiance.values.size(); ++i)
                    rest->radiance.values[i] += of.radiance.values[i];
                for (std::size_t i = 0;
                     i < std::min(rest->error.values.size(), of.error.values.size()); ++i)
                    rest->error.values[i] = std::hypot(rest->error.values[i], of.error.values[i]);
            }
        }
        if (rest) kept.push_back(std::move(*rest));
        subject_.classes = std::move(kept);
    }

    // Values that all are the same where the reference's are not: a display's white.
    void requireNotCutOff(const Image& model) const {
        const float most = *std::max_element(theirs_.values.begin(), theirs_.values.end());
        std::vector<float> there;
        std::size_t counted = 0;
        for (int y = 0; y < model.height; ++y) {
            for (int x = 0; x < model.width; ++x) {
                if (counted_.at(x, y, 0) < 0.5f) continue;
                ++counted;
                const glm::dvec2 place =
                    verdict_.registration.placeOf(glm::dvec2(x + 0.5, y + 0.5), model, theirs_);
                const int column = static_cast<int>(std::floor(
                    verdict_.registration.isFlippedX ? theirs_.width - place.x : place.x));
                const int row = static_cast<int>(std::floor(
                    verdict_.registration.isFlippedY ? theirs_.height - place.y : place.y));
                if (column < 0 || row < 0 || column >= theirs_.width || row >= theirs_.height)
                    continue;
                if (theirs_.at(column, row, 1) >= most * 0.9999f)
                    there.push_back(model.at(x, y, 1));
            }
        }
        if (there.size() < 12 || there.size() < counted / 500) return;
        std::sort(there.begin(), there.end());
        const float low = there[there.size() / 10];
        const float high = there[there.size() - 1 - there.size() / 10];
        if (high > 1.3f * low) {
            throw ConfigError(fmt::format(
                "{} is cut off at {:.4g}, in {:.1f} % of its pixels, as pictures for a display "
                "are; "
                "save linear light as floating point.",
                subject_.theirsName, most,
                100.0 * static_cast<double>(there.size()) / static_cast<double>(counted)));
        }
    }

    // ---- The reference's picture ----

    [[nodiscard]] Image modelOf(bool withDirect) const {
        std::vector<const Image*> parts;
        if (withDirect) parts.push_back(&subject_.direct);
        for (const Light& light : subject_.classes)
            parts.push_back(&light.radiance);
        return sum(parts);
    }

    // Blurred as irradiance, so that the colours of receivers stay sharp.
    [[nodiscard]] Image blurredLight(const Image& radiance) const {
        if (!(blur_ > 0.0)) return radiance;
        Image irradiance(radiance.width, radiance.height, 3);
        Image weight(radiance.width, radiance.height, 3);
        for (std::size_t i = 0; i < radiance.values.size(); ++i) {
            const float fill = subject_.fill.values[i];
            if (!(fill > 0.0f) || subject_.mask.values[i / 3] < 0.5f) continue;
            irradiance.values[i] = radiance.values[i] / fill;
            weight.values[i] = 1.0f;
        }
        irradiance = blurred(irradiance, blur_);
        weight = blurred(weight, blur_);
        Image result(radiance.width, radiance.height, 3);
        for (std::size_t i = 0; i < radiance.values.size(); ++i) {
            if (weight.values[i] > 0.0f)
                result.values[i] =
                    subject_.fill.values[i] * irradiance.values[i] / weight.values[i];
        }
        return result;
    }

    void makeColumns(bool withCauses) {
        columns_.clear();
        std::vector<Image> classes;
        for (const Light& light : subject_.classes)
            classes.push_back(blurredLight(light.radiance));
        std::vector<const Image*> parts;
        for (const Image& image : classes)
            parts.push_back(&image);
        Image all = sum(parts);
        Image allError = quadraticSum(subject_.classes);
        Image model = hasDirect_ ? sum({&subject_.direct, &all}) : all;
        Image dx = derivativeX(model);
        Image dy = derivativeY(model);
        Image scale = derivativeScale(model);
        columns_.push_back({Role::total, 0, std::move(model), allError});
        if (hasDirect_) {
            columns_.push_back({Role::direct, 0, subject_.direct, {}});
            columns_.push_back({Role::allClasses, 0, std::move(all), std::move(allError)});
        }
        for (std::size_t k = 0; k < classes.size(); ++k) {
            columns_.push_back(
                {Role::lightClass, k, std::move(classes[k]), subject_.classes[k].error});
        }
        columns_.push_back({Role::shiftX, 0, std::move(dx), {}});
        columns_.push_back({Role::shiftY, 0, std::move(dy), {}});
        columns_.push_back({Role::scale, 0, std::move(scale), {}});
        columns_.push_back({Role::fill, 0, subject_.fill, {}});
        for (std::size_t k = 0; withCauses && k < subject_.causes.size(); ++k) {
            columns_.push_back({Role::cause, k, blurredLight(subject_.causes[k].radiance),
                                subject_.causes[k].error});
        }
        isPositive_.clear();
        for (const Column& column : columns_) {
            isPositive_.push_back(column.role == Role::direct || column.role == Role::lightClass ||
                                  column.role == Role::total || column.role == Role::cause);
        }
    }

    [[nodiscard]] static Image quadraticSum(const std::vector<Light>& lights) {
        Image result;
        for (const Light& light : lights) {
            if (isEmpty(light.error)) continue;
            if (isEmpty(result))
                result = Image(light.error.width, light.error.height, light.error.channels);
            for (std::size_t i = 0; i < result.values.size(); ++i)
                result.values[i] = std::hypot(result.values[i], light.error.values[i]);
        }
        return result;
    }

    [[nodiscard]] std::vector<std::size_t> columnsOf(std::initializer_list<Role> roles) const {
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (std::find(roles.begin(), roles.end(), columns_[i].role) != roles.end())
                result.push_back(i);
        }
        return result;
    }

    // ---- Weights and the fit ----

    // As if pixels were wrong by a share of their light: where nothing is known yet.
    void weighByLight() {
        const Image& model = columns_.front().image;
        Image counted = counted_;
        const double pixels = std::max(total(onePerPixel(counted), counted), 1.0);
        const double mean = total(model, counted) / (3.0 * pixels);
        weight_ = Image(model.width, model.height, 3);
        for (std::size_t i = 0; i < weight_.values.size(); ++i) {
            const double light = static_cast<double>(model.values[i]);
            weight_.values[i] = static_cast<float>(
                counted_.values[i / 3] > 0.5f
                    ? 1.0 / (std::pow(0.05 * light, 2.0) + std::pow(0.05 * mean, 2.0))
                    : 0.0);
        }
    }

    // Huber's: what is far off counts by its size and not by its square, since where the two
    // pictures differ most there is some other mistake. Gives the mean loss.
    double calm(const LinearFit& fitted) {
        constexpr double kFarOff = 1.5;  // standard deviations
        const Image prediction = predictionOf(fitted);
        double loss = 0.0;
        for (std::size_t i = 0; i < weight_.values.size(); ++i) {
            const auto weight = static_cast<double>(plainWeight_.values[i]);
            if (!(weight > 0.0)) continue;
            const double off =
                std::abs(static_cast<double>(picture_.values[i] - prediction.values[i])) *
                std::sqrt(weight);
            weight_.values[i] =
                static_cast<float>(weight * std::min(1.0, kFarOff / std::max(off, 1e-12)));
            loss += off < kFarOff ? 0.5 * off * off : kFarOff * (off - 0.5 * kFarOff);
        }
        return loss / std::max(static_cast<double>(equations_.rows), 1.0);
    }

    // How little their picture is like any mixture of what is known, as it is registered.
    [[nodiscard]] double lossOfRegistration() {
        align();
        weighByLight();
        plainWeight_ = weight_;
        double loss = 0.0;
        for (int round = 0; round < 3; ++round) {
            makeEquations();
            loss = calm(fit(columnsOf({Role::direct, Role::lightClass, Role::cause, Role::fill})));
        }
        return loss;
    }

    [[nodiscard]] static Image onePerPixel(const Image& mask) {
        Image result(mask.width, mask.height, 1);
        std::fill(result.values.begin(), result.values.end(), 1.0f);
        return result;
    }

    void makeEquations() {
        equations_ = NormalEquations(columns_.size());
        const std::size_t n = columns_.size();
        std::vector<double> row(n);
        Symmetric noise(n);
        for (std::size_t i = 0; i < weight_.values.size(); ++i) {
            const auto weight = static_cast<double>(weight_.values[i]);
            if (!(weight > 0.0)) continue;
            const auto y = static_cast<double>(picture_.values[i]);
            ++equations_.rows;
            equations_.squares += weight * y * y;
            for (std::size_t j = 0; j < n; ++j) {
                row[j] = static_cast<double>(columns_[j].image.values[i]);
                equations_.right[j] += weight * row[j] * y;
                for (std::size_t k = 0; k <= j; ++k)
                    equations_.matrix.at(j, k) += weight * row[j] * row[k];
            }
            addNoise(i, weight, noise);
        }
        // The noise of a column makes its square too large, and its coefficient too small; of a
        // column that is little but noise no more than half is taken off.
        std::vector<double> share(n, 0.0);
        for (std::size_t j = 0; j < n; ++j) {
            if (noise.at(j, j) > 0.0)
                share[j] =
                    std::sqrt(std::min(1.0, 0.5 * equations_.matrix.at(j, j) / noise.at(j, j)));
        }
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t k = 0; k <= j; ++k) {
                equations_.matrix.at(j, k) -= share[j] * share[k] * noise.at(j, k);
                equations_.matrix.at(k, j) = equations_.matrix.at(j, k);
            }
        }
    }

    // The classes are independent of each other; the whole and all of them have their noise.
    void addNoise(std::size_t i, double weight, Symmetric& noise) const {
        for (std::size_t j = 0; j < columns_.size(); ++j) {
            if (isEmpty(columns_[j].error)) continue;
            const double own = std::pow(static_cast<double>(columns_[j].error.values[i]), 2.0);
            noise.at(j, j) += weight * own;
            for (std::size_t k = 0; k < j; ++k) {
                const bool isShared =
                    (columns_[k].role == Role::total || columns_[k].role == Role::allClasses) &&
                    (columns_[j].role == Role::lightClass || columns_[j].role == Role::allClasses);
                if (isShared) noise.at(j, k) += weight * own;
            }
        }
    }

    [[nodiscard]] LinearFit fit(const std::vector<std::size_t>& columns) const {
        return fitColumns(equations_, columns, isPositive_);
    }

    [[nodiscard]] double coefficient(const LinearFit& fitted, std::size_t column) const {
        for (std::size_t i = 0; i < fitted.columns.size(); ++i) {
            if (fitted.columns[i] == column) return fitted.values[i];
        }
        return 0.0;
    }

    [[nodiscard]] Image predictionOf(const LinearFit& fitted) const {
        Image result(picture_.width, picture_.height, 3);
        for (std::size_t j = 0; j < fitted.columns.size(); ++j) {
            const Image& image = columns_[fitted.columns[j]].image;
            const auto value = static_cast<float>(fitted.values[j]);
            for (std::size_t i = 0; i < result.values.size(); ++i)
                result.values[i] += value * image.values[i];
        }
        return result;
    }

    // The covariance of what is fitted, by sums over blocks of pixels; it is never taken for less
    // than what independent pixels would give.
    [[nodiscard]] Symmetric covarianceOf(const LinearFit& fitted) const {
        std::vector<std::size_t> free;
        for (std::size_t i = 0; i < fitted.columns.size(); ++i) {
            if (!fitted.isHeld[i]) free.push_back(fitted.columns[i]);
        }
        const std::size_t n = free.size();
        const int side = std::max(4, picture_.width / 24);
        const int across = (picture_.width + side - 1) / side;
        const int down = (picture_.height + side - 1) / side;
        std::vector<double> sums(static_cast<std::size_t>(across * down) * n, 0.0);
        const Image prediction = predictionOf(fitted);
        for (int y = 0; y < picture_.height; ++y) {
            for (int x = 0; x < picture_.width; ++x) {
                const auto block = static_cast<std::size_t>(y / side * across + x / side);
                for (int c = 0; c < 3; ++c) {
                    const auto weight = static_cast<double>(weight_.at(x, y, c));
                    if (!(weight > 0.0)) continue;
                    const double residual =
                        static_cast<double>(picture_.at(x, y, c) - prediction.at(x, y, c));
                    for (std::size_t j = 0; j < n; ++j) {
                        sums[block * n + j] +=
                            weight * residual *
                            static_cast<double>(columns_[free[j]].image.at(x, y, c));
                    }
                }
            }
        }
        Symmetric meat(n);
        for (std::size_t block = 0; block < sums.size() / std::max<std::size_t>(n, 1); ++block) {
            for (std::size_t j = 0; j < n; ++j) {
                for (std::size_t k = 0; k < n; ++k)
                    meat.at(j, k) += sums[block * n + j] * sums[block * n + k];
            }
        }
        Symmetric covariance(n);
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t k = 0; k < n; ++k) {
                double value = 0.0;
                for (std::size_t a = 0; a < n; ++a) {
                    for (std::size_t b = 0; b < n; ++b)
                        value += fitted.inverse.at(j, a) * meat.at(a, b) * fitted.inverse.at(b, k);
                }
                covariance.at(j, k) = value;
            }
        }
        for (std::size_t j = 0; j < n; ++j)
            covariance.at(j, j) = std::max(covariance.at(j, j), fitted.inverse.at(j, j));
        // As large as the fitted set, with nothing for what is held at 0.
        Symmetric whole(fitted.columns.size());
        std::size_t row = 0;
        for (std::size_t i = 0; i < fitted.columns.size(); ++i) {
            if (fitted.isHeld[i]) continue;
            std::size_t column = 0;
            for (std::size_t j = 0; j < fitted.columns.size(); ++j) {
                if (fitted.isHeld[j]) continue;
                whole.at(i, j) = covariance.at(row, column++);
            }
            ++row;
        }
        return whole;
    }

    // ---- Registration and what the values mean ----

    void align() {
        counted_ =
            verdict_.glassIsHidden || options_.glass == Glass::automatic ? subject_.mask : clear_;
        if (isGlassDecided_ && !verdict_.glassIsHidden) counted_ = clear_;
        const Image linear = decoded(theirs_, verdict_.encoding);
        picture_ = resampled(linear, verdict_.registration, columns_.front().image, counted_);
        // Near to the reference's units, so that coefficients are near 1.
        const double ours = total(columns_.front().image, counted_);
        const double light = total(picture_, counted_);
        firstExposure_ = light > 0.0 && ours > 0.0 ? light / ours : 1.0;
        for (float& value : picture_.values)
            value = static_cast<float>(static_cast<double>(value) / firstExposure_);
        theirsError_ = Image();
        if (!isEmpty(subject_.theirsError)) {
            Image ignored = counted_;
            theirsError_ = resampled(threeChannels(subject_.theirsError), verdict_.registration,
                                     columns_.front().image, ignored);
            for (float& value : theirsError_.values)
                value = static_cast<float>(static_cast<double>(value) / firstExposure_);
        }
    }

    void registerPictures() {
        makeColumns(false);
        Image model = modelOf(hasDirect_);
        verdict_.registration = findRegistration(theirs_, model, counted_);
        // A mistake that changes all of a caustic is no other way up.
        for (const Cause& cause : subject_.causes) {
            if (cause.kind != CauseKind::whole) continue;
            const Registration other =
                findRegistration(theirs_, sum({&model, &cause.radiance}), counted_);
            if (other.correlation > verdict_.registration.correlation + 0.01)
                verdict_.registration = other;
        }
        // Without the direct light that was thought to be there they may be the same.
        if (hasDirect_ && options_.direct == DirectLight::automatic) {
            const Image caustics = modelOf(false);
            const Registration other = findRegistration(theirs_, caustics, counted_);
            if (other.correlation > kSureCorrelation &&
                other.correlation > verdict_.registration.correlation + 0.15) {
                verdict_.registration = other;
                hasDirect_ = false;
                model = caustics;
                makeColumns(false);
            }
        }
        if (verdict_.registration.correlation < kLeastCorrelation) {
            throw ConfigError(fmt::format(
                "{} does not show {} from its camera: however it is turned, moved and scaled, it "
                "is "
                "no more like the reference than a correlation of {:.2f}.",
                subject_.theirsName, subject_.scene, verdict_.registration.correlation));
        }
        decideEncoding();
        requireNotCutOff(model);
    }

    void decideEncoding() {
        if (options_.encoding != Encoding::automatic) {
            verdict_.encoding = options_.encoding;
            align();
            return;
        }
        double best = 0.0;
        Encoding found = Encoding::linear;
        for (const Encoding encoding : {Encoding::linear, Encoding::srgb, Encoding::gamma22}) {
            verdict_.encoding = encoding;
            align();
            weighByLight();
            makeEquations();
            const LinearFit fitted =
                fit(columnsOf({Role::direct, Role::lightClass, Role::shiftX, Role::shiftY}));
            const double unexplained = fitted.chiSquared / std::max(equations_.squares, 1e-300);
            encodingScores_.push_back(unexplained);
            // Linear is the rule; of the others the better one.
            if (encoding == Encoding::linear || unexplained < 0.6 * best ||
                (found != Encoding::linear && unexplained < best)) {
                best = unexplained;
                found = encoding;
            }
        }
        verdict_.encoding = found;
        align();
    }

    void decideGlass() {
        const double glass =
            total(onePerPixel(counted_), counted_) - total(onePerPixel(counted_), clear_);
        isGlassDecided_ = true;
        verdict_.glassIsHidden = true;
        if (glass > 0.0) {
            weighByLight();
            makeEquations();
            const Image prediction = predictionOf(
                fit(columnsOf({Role::direct, Role::lightClass, Role::shiftX, Role::shiftY})));
            double difference = 0.0;
            double light = 0.0;
            for (std::size_t i = 0; i < picture_.values.size(); ++i) {
                if (counted_.values[i / 3] < 0.5f || clear_.values[i / 3] > 0.5f) continue;
                difference +=
                    std::abs(static_cast<double>(picture_.values[i] - prediction.values[i]));
                light += static_cast<double>(prediction.values[i]);
            }
            verdict_.glassIsHidden = difference < 0.35 * light;
        }
        align();
    }

    void decideDirect() {
        if (!hasDirect_ || options_.direct != DirectLight::automatic) return;
        weighByLight();
        makeEquations();
        const LinearFit fitted = fit(columnsOf({Role::direct, Role::lightClass}));
        const double direct = coefficient(fitted, columnsOf({Role::direct}).front());
        // Classes of little light may have any coefficient: what counts is the light.
        const double there = direct * total(subject_.direct, counted_) / total(picture_, counted_);
        const double expected =
            total(subject_.direct, counted_) / total(columns_.front().image, counted_);
        if (there > 0.1 * expected) return;
        hasDirect_ = false;
        makeColumns(false);
        align();
    }

    // To a fraction of a pixel, together with all causes: what moves a caustic may be another
    // index.
    void refine() {
        const Registration before = verdict_.registration;
        const bool isPlain = before.shift == glm::dvec2(0.0);
        makeColumns(true);
        glm::dvec2 error(0.0);
        double scaleError = 0.0;
        for (int round = 0; round < 8; ++round) {
            align();
            weighByLight();
            plainWeight_ = weight_;
            makeEquations();
            static_cast<void>(
                calm(fit(columnsOf({Role::direct, Role::lightClass, Role::cause, Role::fill}))));
            makeEquations();
            const std::vector<std::size_t> columns =
                columnsOf({Role::direct, Role::lightClass, Role::shiftX, Role::shiftY, Role::scale,
                           Role::fill});
            std::vector<std::size_t> more = columns;
            for (const std::size_t cause : columnsOf({Role::cause}))
                more.push_back(cause);
            LinearFit fitted = fit(more);
            if (!fitted.isSolved()) fitted = fit(columns);
            if (!fitted.isSolved()) break;
            const Symmetric covariance = covarianceOf(fitted);
            // Where other columns take the light's place, nothing is known of where it lies.
            if (lightOf(fitted) < 0.2) break;
            // Coefficients of derivatives are steps where those of the light are 1.
            const double light = std::max(lightOf(fitted), 1e-6);
            const auto step = [&](Role role, double& deviation) {
                const std::size_t column = columnsOf({role}).front();
                const auto place = static_cast<std::size_t>(
                    std::find(fitted.columns.begin(), fitted.columns.end(), column) -
                    fitted.columns.begin());
                deviation = std::sqrt(std::max(covariance.at(place, place), 0.0)) / light;
                return fitted.values[place] / light;
            };
            const double dx = std::clamp(step(Role::shiftX, error.x), -1.5, 1.5);
            const double dy = std::clamp(step(Role::shiftY, error.y), -1.5, 1.5);
            const double ds = std::clamp(step(Role::scale, scaleError), -0.03, 0.03);
            Registration& registration = verdict_.registration;
            registration.shift -= registration.scale * glm::dvec2(dx, dy);
            registration.scale *= 1.0 - ds;
            if (std::abs(dx) + std::abs(dy) < 0.01 && std::abs(ds) < 1e-4) break;
        }
        Registration& registration = verdict_.registration;
        const double usual = static_cast<double>(theirs_.height) / columns_.front().image.height;
        const auto isNothing = [](double value, double least, double deviation) {
            return std::abs(value) < std::max(least, kSignificant * deviation);
        };
        if (isNothing(registration.scale / usual - 1.0, kLeastScale, scaleError))
            registration.scale = usual;
        if (isNothing(registration.scale - 1.0, kLeastScale, scaleError)) registration.scale = 1.0;
        for (glm::length_t axis = 0; axis < 2; ++axis) {
            double& shift = registration.shift[axis];
            if (isPlain && isNothing(shift, kLeastShift, error[axis])) shift = 0.0;
            // Halves of a pixel are conventions, and whole ones need no interpolation.
            const double half = 0.5 * std::round(2.0 * shift);
            if (std::abs(shift - half) < std::max(0.06, 2.0 * error[axis]) && half != 0.0)
                shift = half;
        }
        // Where it lies as it should, only what is better by much is another place.
        Registration plain;
        plain.isFlippedX = registration.isFlippedX;
        plain.isFlippedY = registration.isFlippedY;
        plain.scale = usual;
        plain.correlation = registration.correlation;
        if (isPlain && before.scale == usual &&
            (registration.shift != glm::dvec2(0.0) || registration.scale != usual)) {
            const Registration refined = registration;
            const double loss = lossOfRegistration();
            registration = plain;
            if (loss < kBetterPlace * lossOfRegistration()) registration = refined;
        }
        shiftError_ = error;
        scaleError_ = scaleError;
        align();
    }

    // Of what the coefficients of the light are about: direct light's, or the largest class's.
    [[nodiscard]] double lightOf(const LinearFit& fitted) const {
        if (hasDirect_) return coefficient(fitted, columnsOf({Role::direct}).front());
        return coefficient(fitted, brightestColumn());
    }

    [[nodiscard]] std::size_t brightestColumn() const {
        std::size_t brightest = columnsOf({Role::lightClass}).front();
        double most = -1.0;
        for (const std::size_t column : columnsOf({Role::lightClass})) {
            const double light = total(columns_[column].image, counted_);
            if (light > most) brightest = column;
            most = std::max(most, light);
        }
        return brightest;
    }

    // ---- Noise and blur ----

    void weigh() {
        weighByLight();
        for (int round = 0; round < 2; ++round) {
            makeEquations();
            const std::vector<std::size_t> columns =
                columnsOf({Role::direct, Role::lightClass, Role::cause, Role::shiftX, Role::shiftY,
                           Role::fill});
            LinearFit fitted = fit(columns);
            if (!fitted.isSolved()) fitted = fit(columnsOf({Role::direct, Role::lightClass}));
            Image prediction = predictionOf(fitted);
            Image residual(picture_.width, picture_.height, 3);
            for (std::size_t i = 0; i < residual.values.size(); ++i)
                residual.values[i] = picture_.values[i] - prediction.values[i];
            for (float& value : prediction.values)
                value = std::max(value, 0.0f);
            Image known(picture_.width, picture_.height, 3);
            if (!isEmpty(columns_.front().error)) known = columns_.front().error;
            Image noise = isEmpty(theirsError_) ? noiseOf(residual, prediction, known, counted_)
                                                : theirsError_;
            const double mean = total(prediction, counted_) /
                                std::max(3.0 * total(onePerPixel(counted_), counted_), 1.0);
            deviation_ = Image(picture_.width, picture_.height, 3);
            for (std::size_t i = 0; i < noise.values.size(); ++i) {
                const auto light = static_cast<double>(prediction.values[i]);
                const double variance = std::pow(static_cast<double>(noise.values[i]), 2.0) +
                                        std::pow(static_cast<double>(known.values[i]), 2.0) +
                                        std::pow(kFloorOfLight * light, 2.0) +
                                        std::pow(kFloorOfMean * mean, 2.0);
                deviation_.values[i] = static_cast<float>(std::sqrt(variance));
                weight_.values[i] = counted_.values[i / 3] > 0.5f && variance > 0.0
                                        ? static_cast<float>(1.0 / variance)
                                        : 0.0f;
            }
        }
        makeEquations();
    }

    void decideBlur() {
        const auto unexplained = [&](double sigma) {
            blur_ = sigma;
            makeColumns(true);
            makeEquations();
            return fit(columnsOf({Role::direct, Role::lightClass, Role::cause, Role::fill}))
                .chiSquared;
        };
        const double sharp = unexplained(0.0);
        double best = sharp;
        double found = 0.0;
        for (const double sigma : {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0}) {
            const double now = unexplained(sigma);
            if (now >= best) continue;
            best = now;
            found = sigma;
        }
        if (best > 0.95 * sharp || found < kLeastBlur) found = 0.0;
        blur_ = found;
        verdict_.blurPixels = found;
        makeColumns(true);
    }

    // ---- Causes ----

    [[nodiscard]] bool isRegistered() const {
        const double usual = static_cast<double>(theirs_.height) / picture_.height;
        return verdict_.registration.shift != glm::dvec2(0.0) ||
               verdict_.registration.scale != usual;
    }

    [[nodiscard]] std::vector<Candidate> candidates() const {
        std::vector<Candidate> all;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const Column& column = columns_[i];
            const Candidate alone{{i}, column.role, column.index, {1.0}};
            // What was registered is not asked for again.
            const bool isPlace = column.role == Role::shiftX || column.role == Role::scale;
            if (isPlace && isRegistered()) continue;
            switch (column.role) {
                case Role::allClasses:
                case Role::scale:
                case Role::fill:
                    all.push_back(alone);
                    break;
                case Role::cause:
                    addCause(i, all);
                    break;
                case Role::lightClass:
                    if (hasDirect_ || subject_.classes.size() > 1) all.push_back(alone);
                    break;
                case Role::shiftX:
                    all.push_back({{i, i + 1}, column.role, 0, {1.0, 1.0}});
                    break;
                default:
                    break;
            }
        }
        return all;
    }

    // Pictures of the same cause in the same direction are one candidate: what lies between two is
    // a mixture of them.
    void addCause(std::size_t column, std::vector<Candidate>& all) const {
        const std::size_t index = columns_[column].index;
        const Cause& cause = subject_.causes[index];
        const double step = cause.kind == CauseKind::amount ? cause.amount : 1.0;
        for (Candidate& other : all) {
            if (other.role != Role::cause || subject_.causes[other.index].name != cause.name ||
                other.steps.front() * step < 0.0)
                continue;
            other.columns.push_back(column);
            other.steps.push_back(step);
            return;
        }
        all.push_back({{column}, Role::cause, index, {step}});
    }

    struct Trial {
        double gain = 0.0;
        bool isWorthAWord = false;
        std::vector<double> amounts;  // with the light's coefficient as 1
    };
    [[nodiscard]] Trial tried(const std::vector<std::size_t>& selected, double before,
                              const Candidate& candidate) const {
        std::vector<std::size_t> columns = selected;
        columns.insert(columns.end(), candidate.columns.begin(), candidate.columns.end());
        const LinearFit fitted = fit(columns);
        Trial trial;
        if (!fitted.isSolved()) return trial;
        trial.gain = before - fitted.chiSquared;
        const double light = std::max(coefficient(fitted, 0), 1e-9);
        for (const std::size_t column : candidate.columns)
            trial.amounts.push_back(coefficient(fitted, column) / light);
        if (candidate.role == Role::cause) {
            trial.amounts.front() *= candidate.steps.front();
            for (std::size_t i = 1; i < candidate.steps.size(); ++i)
                trial.amounts.front() += candidate.steps[i] * trial.amounts[i];
        }
        const double amount = std::abs(trial.amounts.front());
        switch (candidate.role) {
            case Role::lightClass:
            case Role::allClasses:
                trial.isWorthAWord = amount > kRightWithin;
                break;
            case Role::shiftX:
                trial.isWorthAWord = std::hypot(trial.amounts[0], trial.amounts[1]) > kLeastShift;
                break;
            case Role::scale:
                trial.isWorthAWord = amount > kLeastScale;
                break;
            case Role::fill:
                trial.isWorthAWord = amount * total(subject_.fill, counted_) >
                                     0.005 * total(columns_.front().image, counted_);
                break;
            default: {
                const Cause& cause = subject_.causes[candidate.index];
                trial.isWorthAWord =
                    cause.kind == CauseKind::whole
                        ? trial.amounts.front() > 0.5 && trial.amounts.front() < 1.5
                        : amount > cause.least;
            }
        }
        return trial;
    }

    void selectCauses() {
        makeEquations();
        std::vector<std::size_t> selected = {0};
        std::vector<Candidate> open = candidates();
        const double first = fit(selected).chiSquared;
        // What no mixture of causes explains: the unit of what is significant.
        std::vector<std::size_t> everything = columnsOf(
            {Role::direct, Role::lightClass, Role::cause, Role::shiftX, Role::shiftY, Role::fill});
        if (!hasDirect_) {
            // The whole is the sum of its classes.
            everything =
                columnsOf({Role::lightClass, Role::cause, Role::shiftX, Role::shiftY, Role::fill});
        }
        const LinearFit best = fit(everything);
        const double unit = std::max(1.0, (best.isSolved() ? best.chiSquared : first) /
                                              std::max(static_cast<double>(equations_.rows), 1.0));
        double now = first;
        for (int round = 0; round < 6 && !open.empty(); ++round) {
            std::vector<Trial> trials;
            std::size_t chosen = open.size();
            for (const Candidate& candidate : open) {
                trials.push_back(tried(selected, now, candidate));
                if (!trials.back().isWorthAWord) continue;
                if (chosen == open.size() || trials.back().gain > trials[chosen].gain)
                    chosen = trials.size() - 1;
            }
            if (chosen == open.size()) break;
            const double gain = trials[chosen].gain;
            if (gain < kLeastGain * now || gain < 30.0 * unit) break;
            Choice choice{open[chosen], {}};
            for (std::size_t i = 0; i < open.size(); ++i) {
                if (i != chosen && trials[i].isWorthAWord && trials[i].gain >= kAsWell * gain)
                    choice.also.push_back(sentenceOf(open[i], trials[i].amounts, {}));
            }
            selected.insert(selected.end(), open[chosen].columns.begin(),
                            open[chosen].columns.end());
            choices_.push_back(std::move(choice));
            now = fit(selected).chiSquared;
            open.erase(open.begin() + static_cast<std::ptrdiff_t>(chosen));
        }
    }

    static std::string plusMinus(double value, const std::vector<double>& errors,
                                 const char* format) {
        std::string result = fmt::format(fmt::runtime(format), value);
        if (!errors.empty()) result += " ± " + fmt::format(fmt::runtime("{:.2g}"), errors.front());
        return result;
    }

    // `amounts` and `errors`: of the candidate's columns.
    [[nodiscard]] std::string sentenceOf(const Candidate& candidate,
                                         const std::vector<double>& amounts,
                                         const std::vector<double>& errors) const {
        const double amount = amounts.front();
        switch (candidate.role) {
            case Role::lightClass:
                return fmt::format("{} ({}) has another strength: c = {}",
                                   titleOf(subject_.classes[candidate.index].name),
                                   subject_.classes[candidate.index].name,
                                   plusMinus(1.0 + amount, errors, "{:.3f}"));
            case Role::allClasses:
                return fmt::format("all caustic light has another strength: c = {}",
                                   plusMinus(1.0 + amount, errors, "{:.3f}"));
            case Role::shiftX:
                return fmt::format("the picture is moved by ({:+.2f}, {:+.2f}) pixels", -amounts[0],
                                   -amounts[1]);
            case Role::scale:
                return fmt::format("the vertical field of view is {:.3f} degrees instead of {:.3f}",
                                   fovOf(1.0 - amount), subject_.verticalFovDegrees);
            case Role::fill:
                return fmt::format(
                    "receivers have an even light of {} W/m² that is not the "
                    "scene's (ambient light, or light between them)",
                    plusMinus(amount, errors, "{:.3g}"));
            default: {
                const Cause& cause = subject_.causes[candidate.index];
                if (cause.kind == CauseKind::whole) return cause.sentence;
                return fmt::format("{} is off by {}{}{}", cause.name,
                                   plusMinus(amount, errors, "{:+.3g}"),
                                   cause.unit.empty() ? "" : " ", cause.unit);
            }
        }
    }

    // Their field of view, where a step of the reference's pixels is `scale` of theirs.
    [[nodiscard]] double fovOf(double scale) const {
        const double tangent = std::tan(0.5 * subject_.verticalFovDegrees * kPi / 180.0);
        return 2.0 * std::atan(tangent / scale) * 180.0 / kPi;
    }

    // ---- Findings ----

    void find(std::string name, double value, double error, std::string sentence,
              std::vector<std::string> also = {}) {
        verdict_.findings.push_back(
            {std::move(name), value, error, std::move(sentence), std::move(also)});
    }

    void findRegistrations() {
        const Registration& registration = verdict_.registration;
        if (registration.isFlippedX && registration.isFlippedY) {
            find("turned", 1.0, 0.0, "the picture is turned by 180 degrees");
        } else if (registration.isFlippedX) {
            find("flipped-x", 1.0, 0.0,
                 "the picture is mirrored left to right, as by a camera of the other handedness");
        } else if (registration.isFlippedY) {
            find("flipped-y", 1.0, 0.0, "the picture is upside down: its first row is the lowest");
        }
        const Image& ours = columns_.front().image;
        const double usual = static_cast<double>(theirs_.height) / ours.height;
        const bool isSameSize = theirs_.width == ours.width && theirs_.height == ours.height;
        const double zoom = registration.scale / usual;
        const glm::dvec2 shift = registration.shift;
        if (!isSameSize && registration.scale == 1.0) {
            const glm::dvec2 corner =
                0.5 * glm::dvec2(ours.width - theirs_.width, ours.height - theirs_.height) - shift;
            find(
                "crop", 1.0, 0.0,
                fmt::format("the picture is a part of {}x{} pixels, its corner at ({:.1f}, {:.1f})",
                            theirs_.width, theirs_.height, corner.x, corner.y));
            return;
        }
        if (!isSameSize && zoom == 1.0)
            find("size", registration.scale, 0.0,
                 fmt::format("the picture has {}x{} pixels where the reference has {}x{}",
                             theirs_.width, theirs_.height, ours.width, ours.height));
        if (std::abs(zoom - 1.0) > 1e-9) {
            const double fov = fovOf(zoom);
            const double error =
                std::abs(fovOf(zoom + scaleError_) - fovOf(zoom - scaleError_)) / 2.0;
            find("field-of-view", fov, error,
                 fmt::format("the vertical field of view is {:.2f} ± {:.2g} degrees instead of "
                             "{:.2f}{}",
                             fov, error, subject_.verticalFovDegrees, aspectHint(zoom)));
        }
        if (shift != glm::dvec2(0.0)) {
            const auto isHalf = [](double value) {
                return value == 0.0 || std::abs(std::abs(value) - 0.5) < 1e-9;
            };
            find("shift", glm::length(shift), glm::length(shiftError_),
                 fmt::format("the picture is moved by ({:+.2f}, {:+.2f}) ± ({:.2g}, {:.2g}) pixels "
                             "to the right and down{}",
                             shift.x, shift.y, shiftError_.x, shiftError_.y,
                             isHalf(shift.x) && isHalf(shift.y)
                                 ? ", half a pixel: its rays go through the corners of pixels"
                                 : ""));
        }
    }

    // The horizontal angle taken for the vertical one, or the other way round.
    [[nodiscard]] std::string aspectHint(double zoom) const {
        const Image& ours = columns_.front().image;
        const double aspect = static_cast<double>(ours.width) / ours.height;
        if (std::abs(zoom * aspect - 1.0) < 0.02) return ": that is the horizontal one";
        if (std::abs(zoom / aspect - 1.0) < 0.02)
            return ": what is vertical here was taken for the horizontal one";
        return "";
    }

    void findEncoding() {
        if (verdict_.encoding == Encoding::linear) return;
        std::vector<std::string> also;
        if (encodingScores_.size() == 3 &&
            std::max(encodingScores_[1], encodingScores_[2]) <
                1.15 * std::min(encodingScores_[1], encodingScores_[2])) {
            also.emplace_back(verdict_.encoding == Encoding::srgb ? "a power of 1/2.2"
                                                                  : "the sRGB curve");
        }
        find("encoding", 0.0, 0.0,
             fmt::format(
                 "its values are not linear light: they are coded by {}",
                 verdict_.encoding == Encoding::srgb ? "the sRGB curve" : "a power of 1/2.2"),
             also);
    }

    // A factor of each channel for what is fitted to all of them together.
    void findChannels(const LinearFit& fitted) {
        const Image prediction = predictionOf(fitted);
        glm::dvec3 products(0.0);
        glm::dvec3 squares(0.0);
        for (std::size_t i = 0; i < weight_.values.size(); ++i) {
            const auto weight = static_cast<double>(weight_.values[i]);
            const auto light = static_cast<double>(prediction.values[i]);
            const auto channel = static_cast<glm::length_t>(i % 3);
            products[channel] += weight * light * static_cast<double>(picture_.values[i]);
            squares[channel] += weight * light * light;
        }
        const glm::dvec3 factors = products / glm::max(squares, glm::dvec3(1e-300));
        const double mean = (factors.r + factors.g + factors.b) / 3.0;
        const double spread = std::max({factors.r, factors.g, factors.b}) -
                              std::min({factors.r, factors.g, factors.b});
        if (!(spread > kLeastColor * mean)) return;
        find("channels", spread / mean, 0.0,
             fmt::format("its channels have other exposures, red {:.3f}, green {:.3f} and blue "
                         "{:.3f} of the mean: a white balance, a light's colour or other primaries",
                         factors.r / mean, factors.g / mean, factors.b / mean));
    }

    // What factors of a class mean.
    [[nodiscard]] std::string meaningOf(double value, double error) const {
        std::vector<std::pair<double, std::string>> known = {
            {1.0 / kPi, "1/π"}, {kPi, "π"}, {0.5, "a half"}, {2.0, "twice"}, {4.0, "four times"}};
        for (const NamedIndex& index : subject_.indices) {
            const double square = index.index * index.index;
            known.emplace_back(1.0 / square, fmt::format("1/n² of '{}'", index.material));
            known.emplace_back(square, fmt::format("n² of '{}'", index.material));
        }
        for (const auto& [factor, name] : known) {
            if (std::abs(value - factor) < std::max(2.0 * error, 0.015 * factor))
                return fmt::format(", which is {} ({:.3f})", name, factor);
        }
        return "";
    }

    [[nodiscard]] std::vector<std::string> alsoOf(Role role, std::size_t index) const {
        for (const Choice& choice : choices_) {
            if (choice.candidate.role == role && choice.candidate.index == index)
                return choice.also;
        }
        return {};
    }

    void finish() {
        std::vector<std::size_t> columns = columnsOf({Role::direct, Role::lightClass});
        for (const Choice& choice : choices_) {
            const Role role = choice.candidate.role;
            if (role == Role::lightClass || role == Role::allClasses) continue;
            columns.insert(columns.end(), choice.candidate.columns.begin(),
                           choice.candidate.columns.end());
        }
        const LinearFit fitted = fit(columns);
        const Symmetric covariance = covarianceOf(fitted);
        setExposure(fitted, covariance);
        setClasses(fitted, covariance);
        findRegistrations();
        findEncoding();
        findChannels(fitted);
        if (verdict_.blurPixels > 0.0) {
            find(
                "blur", verdict_.blurPixels, 0.0,
                fmt::format("its caustics are blurred by {:.2g} pixels (standard deviation), as by "
                            "a filter or the kernel of a photon map",
                            verdict_.blurPixels));
        }
        findCauses(fitted, covariance);
        findClasses();
        setResidual(fitted);
    }

    [[nodiscard]] static std::size_t placeOf(const LinearFit& fitted, std::size_t column) {
        return static_cast<std::size_t>(
            std::find(fitted.columns.begin(), fitted.columns.end(), column) -
            fitted.columns.begin());
    }

    void setExposure(const LinearFit& fitted, const Symmetric& covariance) {
        const std::size_t by = hasDirect_ ? columnsOf({Role::direct}).front() : brightestColumn();
        exposurePlace_ = placeOf(fitted, by);
        verdict_.hasDirect = hasDirect_;
        verdict_.exposure = fitted.values[exposurePlace_] * firstExposure_;
        verdict_.exposureError =
            std::sqrt(covariance.at(exposurePlace_, exposurePlace_)) * firstExposure_;
        verdict_.exposureBy =
            hasDirect_ ? "direct light" : subject_.classes[columns_[by].index].name;
        exposure_ = fitted.values[exposurePlace_];
        if (!(exposure_ > 0.0)) {
            throw ConfigError(
                fmt::format("{} has nothing of the light of {} where the reference "
                            "has it; it shows another scene.",
                            subject_.theirsName, subject_.scene));
        }
        if (options_.exposure) {
            exposure_ = *options_.exposure / firstExposure_;
            verdict_.exposure = *options_.exposure;
            verdict_.exposureError = 0.0;
            verdict_.exposureBy = "what was said";
        }
    }

    void setClasses(const LinearFit& fitted, const Symmetric& covariance) {
        double light = 0.0;
        for (const Light& of : subject_.classes)
            light += total(of.radiance, counted_);
        for (const std::size_t column : columnsOf({Role::lightClass})) {
            const std::size_t place = placeOf(fitted, column);
            const Light& of = subject_.classes[columns_[column].index];
            ClassVerdict verdict;
            verdict.name = of.name;
            verdict.title = titleOf(of.name);
            verdict.fluxShare = light > 0.0 ? total(of.radiance, counted_) / light : 0.0;
            verdict.coefficient = exposure_ > 0.0 ? fitted.values[place] / exposure_ : 0.0;
            // Of a quotient, the exposure's own error included.
            const double c = verdict.coefficient;
            const bool isGiven = options_.exposure.has_value();
            const double variance =
                covariance.at(place, place) +
                (isGiven ? 0.0
                         : c * c * covariance.at(exposurePlace_, exposurePlace_) -
                               2.0 * c * covariance.at(place, exposurePlace_));
            verdict.error = exposure_ > 0.0 ? std::sqrt(std::max(variance, 0.0)) / exposure_ : 0.0;
            if (fitted.isDropped[place]) {
                verdict.error = HUGE_VAL;
            } else if (fitted.isHeld[place]) {
                // It would be negative; what it would be is known as well as if it were not, as
                // far as the exposure's error is what independent pixels would give.
                const double square = equations_.matrix.at(column, column);
                verdict.error =
                    square > 0.0 ? noiseFactor(fitted, covariance) / (std::sqrt(square) * exposure_)
                                 : HUGE_VAL;
            }
            verdict.verdict = verdictOf(verdict);
            if (place == exposurePlace_ && !isGiven) verdict.verdict = "there";
            verdict_.classes.push_back(verdict);
        }
    }

    // By how much neighbours that share their noise make errors larger.
    [[nodiscard]] double noiseFactor(const LinearFit& fitted, const Symmetric& covariance) const {
        std::size_t row = 0;
        for (std::size_t i = 0; i < exposurePlace_; ++i)
            row += fitted.isHeld[i] ? 0u : 1u;
        return std::sqrt(covariance.at(exposurePlace_, exposurePlace_) /
                         fitted.inverse.at(row, row));
    }

    [[nodiscard]] static std::string verdictOf(const ClassVerdict& of) {
        if (of.error > 0.25) return "cannot be told";
        if (std::abs(of.coefficient - 1.0) <= std::max(kRightWithin, kSignificant * of.error))
            return "there";
        if (of.coefficient < std::max(0.1, 3.0 * of.error)) return "missing";
        return of.coefficient > 1.0 ? "too bright" : "too dark";
    }

    void findCauses(const LinearFit& fitted, const Symmetric& covariance) {
        for (const Choice& choice : choices_) {
            const Role role = choice.candidate.role;
            if (role == Role::lightClass || role == Role::allClasses) continue;
            std::vector<double> amounts;
            std::vector<double> errors;
            const Candidate& candidate = choice.candidate;
            double amount = 0.0;
            double variance = 0.0;
            for (std::size_t i = 0; i < candidate.columns.size(); ++i) {
                const std::size_t place = placeOf(fitted, candidate.columns[i]);
                amounts.push_back(fitted.values[place] / exposure_);
                errors.push_back(std::sqrt(std::max(covariance.at(place, place), 0.0)) / exposure_);
                amount += candidate.steps[i] * amounts.back();
                for (std::size_t j = 0; j < candidate.columns.size(); ++j) {
                    variance += candidate.steps[i] * candidate.steps[j] *
                                covariance.at(place, placeOf(fitted, candidate.columns[j]));
                }
            }
            if (role == Role::cause) {
                amounts = {amount};
                errors = {std::sqrt(std::max(variance, 0.0)) / exposure_};
            }
            const std::string name = role == Role::cause
                                         ? subject_.causes[choice.candidate.index].name
                                     : role == Role::shiftX ? "shift"
                                     : role == Role::scale  ? "field-of-view"
                                                            : "fill";
            find(name, amounts.front(), errors.front(),
                 sentenceOf(choice.candidate, amounts, errors), choice.also);
        }
    }

    void findClasses() {
        if (findCommonFactor()) return;
        for (std::size_t k = 0; k < verdict_.classes.size(); ++k) {
            const ClassVerdict& of = verdict_.classes[k];
            const std::string who = fmt::format("{} ({}, {:.1f} % of the caustic)", of.title,
                                                of.name, 100.0 * of.fluxShare);
            const std::string value = fmt::format("c = {:.3f} ± {:.2g}", of.coefficient, of.error);
            if (of.verdict == "missing") {
                find("missing:" + of.name, of.coefficient, of.error,
                     fmt::format("{} is missing: {}", who, value), alsoOf(Role::lightClass, k));
            } else if (of.verdict == "too bright" || of.verdict == "too dark") {
                find(of.verdict == "too bright" ? "bright:" + of.name : "dark:" + of.name,
                     of.coefficient, of.error,
                     fmt::format("{} is {}: {}{}", who, of.verdict, value,
                                 meaningOf(of.coefficient, of.error)),
                     alsoOf(Role::lightClass, k));
            }
        }
    }

    // Whether all classes that can be told are off by the same; said once then.
    bool findCommonFactor() {
        if (!hasDirect_ && !options_.exposure) return false;
        double weights = 0.0;
        double mean = 0.0;
        std::size_t off = 0;
        std::size_t told = 0;
        for (const ClassVerdict& of : verdict_.classes) {
            if (of.verdict == "cannot be told" || !(of.error > 0.0)) continue;
            ++told;
            off += of.verdict != "there" ? 1u : 0u;
            const double weight = 1.0 / (of.error * of.error + 1e-4);
            weights += weight;
            mean += weight * of.coefficient;
        }
        if (told < 2 || off == 0) return false;
        mean /= weights;
        for (const ClassVerdict& of : verdict_.classes) {
            if (of.verdict == "cannot be told" || !(of.error > 0.0)) continue;
            if (std::abs(of.coefficient - mean) > 3.0 * of.error + 0.02 * mean) return false;
        }
        if (std::abs(mean - 1.0) < kRightWithin) return false;
        const double error = 1.0 / std::sqrt(weights);
        find(mean < 0.1   ? "missing:all"
             : mean > 1.0 ? "bright:all"
                          : "dark:all",
             mean, error,
             mean < 0.1
                 ? fmt::format("all caustic light is missing: c = {:.3f} ± {:.2g}", mean, error)
                 : fmt::format("all caustic light is too {} against direct light: c = {:.3f} ± "
                               "{:.2g}{}",
                               mean > 1.0 ? "bright" : "dark", mean, error, meaningOf(mean, error)),
             alsoOf(Role::allClasses, 0));
        return true;
    }

    void setResidual(const LinearFit& fitted) {
        const Image prediction = predictionOf(fitted);
        verdict_.residual = Image(picture_.width, picture_.height, 3);
        verdict_.z = Image(picture_.width, picture_.height, 1);
        double difference = 0.0;
        double light = 0.0;
        for (int y = 0; y < picture_.height; ++y) {
            for (int x = 0; x < picture_.width; ++x) {
                if (counted_.at(x, y, 0) < 0.5f) continue;
                ++verdict_.pixels;
                double residual = 0.0;
                double variance = 0.0;
                for (int c = 0; c < 3; ++c) {
                    const double of =
                        static_cast<double>(picture_.at(x, y, c) - prediction.at(x, y, c));
                    verdict_.residual.at(x, y, c) = static_cast<float>(of / exposure_);
                    residual += of;
                    // The channels of a photon go together.
                    variance += static_cast<double>(deviation_.at(x, y, c));
                    light += static_cast<double>(prediction.at(x, y, c));
                }
                difference += std::abs(residual);
                verdict_.z.at(x, y, 0) =
                    variance > 0.0 ? static_cast<float>(residual / variance) : 0.0f;
            }
        }
        verdict_.unexplainedShare = light > 0.0 ? difference / light : 0.0;
        const auto pixels = static_cast<double>(std::max<std::size_t>(verdict_.pixels, 1));
        // Šidák's correction.
        verdict_.criticalZ = criticalZ(-std::expm1(std::log1p(-kFalseAlarms) / pixels));
        for (const float z : verdict_.z.values) {
            const double size = std::abs(static_cast<double>(z));
            verdict_.largestZ = std::max(verdict_.largestZ, size);
            verdict_.significantPixels += size > verdict_.criticalZ ? 1u : 0u;
        }
    }

    struct Choice {
        Candidate candidate;
        std::vector<std::string> also;
    };

    Subject subject_;
    JudgeOptions options_;
    Image theirs_;
    Image clear_;    // counted where their eye sees no glass
    Image counted_;  // 1 where pixels count
    Image picture_;  // theirs in the reference's pixels, linear, over the first exposure
    Image theirsError_;
    Image weight_;
    Image plainWeight_;  // before what is far off is made less of
    Image deviation_;
    bool hasDirect_ = true;
    bool isGlassDecided_ = false;
    double firstExposure_ = 1.0;
    double exposure_ = 1.0;  // of `picture_`
    double blur_ = 0.0;
    glm::dvec2 shiftError_{0.0};
    double scaleError_ = 0.0;
    std::size_t exposurePlace_ = 0;
    std::vector<double> encodingScores_;
    std::vector<Column> columns_;
    std::vector<bool> isPositive_;
    NormalEquations equations_;
    std::vector<Choice> choices_;
    Verdict verdict_;
};

}  // namespace

Verdict judge(const Subject& subject, const JudgeOptions& options) {
    return Judgement(subject, options).run();
}

}  // namespace kaustik::judge
