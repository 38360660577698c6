// SPDX-License-Identifier: MIT
// A mixture: a small scene, a technique and settings, as a line of the command line says them; and
// how one is drawn from all that the registry offers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/numerics/frame.h"
#include "framework/pipeline/registry.h"

namespace kaustik::mixtures {

using numerics::Settings;

inline constexpr int kWidth = 160;
inline constexpr int kHeight = 120;

struct Mixture {
    std::string scene;  // of tests/mixtures/scenes
    std::string technique = "screen_space_photons";
    Settings settings;  // by full name, each once

    // Takes the place of the one that is there.
    void set(const std::string& name, const std::string& value);
    void erase(const std::string& name);
};

// "kaustik run tests/mixtures/scenes/ball.toml --size 160x120 --technique … --set …"
[[nodiscard]] std::string lineOf(const Mixture& mixture);
// Such a line, or as much of one as "ball --set trace=lines". Throws ConfigError.
[[nodiscard]] Mixture mixtureOf(const std::string& line);

[[nodiscard]] const Registry& registry();
[[nodiscard]] const std::vector<std::string>& sceneNames();
[[nodiscard]] std::vector<std::string> nodesOf(const std::string& stage);
// All parameters as the mixture has them. Throws ConfigError.
[[nodiscard]] params::ParamSet paramsOf(const Mixture& mixture);

// With few photons, cells and texels, so that it is rendered quickly.
[[nodiscard]] Mixture smallMixture(const std::string& scene);

// Numbers that are the same on every machine.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream);
    [[nodiscard]] std::uint64_t next();
    [[nodiscard]] double uniform();  // [0, 1)
    [[nodiscard]] bool chance(double probability) { return uniform() < probability; }
    [[nodiscard]] std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(next() % count);
    }
    template <class T>
    [[nodiscard]] const T& of(const std::vector<T>& values) {
        return values[below(values.size())];
    }

  private:
    std::uint64_t state_;
};

// Every node, every choice, and numbers at the ends of their ranges and between. What costs much at
// an end is drawn less far (costlyEnds).
[[nodiscard]] Mixture drawMixture(Random& random);

// An end of a range that a drawn mixture does not go to.
struct CostlyEnd {
    std::string name;  // of the parameter, or how it ends
    double minimum = 0.0;
    double maximum = 0.0;
};
[[nodiscard]] const std::vector<CostlyEnd>& costlyEnds();
// Its range while drawing.
[[nodiscard]] params::Range<double> drawnRange(const params::NamedField& parameter);
// The ends that are not drawn, each in a small mixture in which it has an effect.
[[nodiscard]] std::vector<Mixture> mixturesAtCostlyEnds();

}  // namespace kaustik::mixtures
