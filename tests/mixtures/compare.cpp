// SPDX-License-Identifier: MIT
#include "tests/mixtures/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace kaustik::mixtures {
namespace {

struct NamedImages {
    std::string name;
    const Image& one;
    const Image& other;
};

std::vector<NamedImages> pairsOf(const Shot& one, const Shot& other) {
    std::vector<NamedImages> pairs;
    const std::size_t count = std::min(one.outputs.images.size(), other.outputs.images.size());
    for (std::size_t i = 0; i < count; ++i) {
        pairs.push_back({one.outputs.images[i].name, one.outputs.images[i].image,
                         other.outputs.images[i].image});
    }
    return pairs;
}

std::string differenceInOutputs(const Shot& one, const Shot& other) {
    if (one.outputs.images.size() == other.outputs.images.size()) return "";
    return fmt::format("there are {} outputs and {}", one.outputs.images.size(),
                       other.outputs.images.size());
}

double largest(const Image& image) {
    double most = 0.0;
    for (const float value : image.values)
        most = std::max(most, std::abs(static_cast<double>(value)));
    return most;
}

// Sums of squares of 10 x 10 pixels, by channel.
std::vector<double> blocksOf(const Image& image) {
    constexpr int kSide = 10;
    const int columns = (image.width + kSide - 1) / kSide;
    const int rows = (image.height + kSide - 1) / kSide;
    std::vector<double> sums(static_cast<std::size_t>(3 * columns * rows), 0.0);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                sums[static_cast<std::size_t>(3 * ((y / kSide) * columns + x / kSide) + c)] +=
                    static_cast<double>(image.at(x, y, c));
            }
        }
    }
    return sums;
}

}  // namespace

std::string differenceInBits(const Shot& one, const Shot& other) {
    std::string outputs = differenceInOutputs(one, other);
    if (!outputs.empty()) return outputs;
    std::vector<NamedImages> pairs = pairsOf(one, other);
    pairs.push_back({"picture", one.picture, other.picture});
    for (const NamedImages& pair : pairs) {
        std::size_t count = 0;
        double most = 0.0;
        for (std::size_t i = 0; i < pair.one.values.size(); ++i) {
            if (pair.one.values[i] == pair.other.values[i]) continue;
            ++count;
            most = std::max(most, std::abs(static_cast<double>(pair.one.values[i]) -
                                           static_cast<double>(pair.other.values[i])));
        }
        if (count > 0) {
            return fmt::format("{} values of {} differ, by {:.3g} of {:.3g} at most", count,
                               pair.name, most, largest(pair.one));
        }
    }
    for (std::size_t account = 0; account < one.ledger.watts.size(); ++account) {
        if (one.ledger.watts[account] == other.ledger.watts[account]) continue;
        return fmt::format("account {} of the ledger is {:.9g} W and {:.9g} W", account,
                           one.ledger.watts[account], other.ledger.watts[account]);
    }
    return "";
}

std::string differenceInValues(const Shot& one, const Shot& other, double factor, double fluxFactor,
                               double tolerance) {
    std::string outputs = differenceInOutputs(one, other);
    if (!outputs.empty()) return outputs;
    for (const NamedImages& pair : pairsOf(one, other)) {
        const double scale = std::max(largest(pair.one), largest(pair.other) * factor);
        double most = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < pair.one.values.size(); ++i) {
            const double difference = std::abs(static_cast<double>(pair.one.values[i]) -
                                               static_cast<double>(pair.other.values[i]) * factor);
            most = std::max(most, difference);
            count += difference > tolerance * scale ? 1 : 0;
        }
        if (count > 0) {
            return fmt::format("{} values of {} differ, by {:.3g} of {:.3g} at most", count,
                               pair.name, most, scale);
        }
    }
    const double emitted = one.ledger.watts[transport::kAccountEmitted];
    for (std::size_t account = 0; account < one.ledger.watts.size(); ++account) {
        const double watts = other.ledger.watts[account] * fluxFactor;
        if (std::abs(one.ledger.watts[account] - watts) <= tolerance * emitted) continue;
        return fmt::format("account {} of the ledger is {:.9g} W and {:.9g} W", account,
                           one.ledger.watts[account], watts);
    }
    return "";
}

std::string differenceInBlocks(const Shot& one, const Shot& other, double energy, double blocks) {
    std::string outputs = differenceInOutputs(one, other);
    if (!outputs.empty()) return outputs;
    for (const NamedImages& pair : pairsOf(one, other)) {
        const std::vector<double> first = blocksOf(pair.one);
        const std::vector<double> second = blocksOf(pair.other);
        double sums[2] = {0.0, 0.0};
        double apart = 0.0;
        for (std::size_t i = 0; i < first.size(); ++i) {
            sums[0] += first[i];
            sums[1] += second[i];
            apart += std::abs(first[i] - second[i]);
        }
        const double whole = std::max(sums[0], sums[1]);
        if (whole <= 0.0) continue;
        if (std::abs(sums[0] - sums[1]) > energy * whole || apart > blocks * whole) {
            return fmt::format(
                "{} has {:.2f} % of the energy, and squares of 10 pixels differ by "
                "{:.2f} % of it",
                pair.name, 100.0 * sums[1] / sums[0], 100.0 * apart / whole);
        }
    }
    return "";
}

}  // namespace kaustik::mixtures
