// SPDX-License-Identifier: MIT
// Classes of caustic paths: which are kept apart in a reference, and what one of them has found.
// A class is a pattern (path_pattern.h). A path is of the first class that takes it; what none
// takes, and what has more than kLongestPathWord interactions, is `other`, so that the classes are
// all of the caustic.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "framework/reference/path_pattern.h"
#include "framework/scene/scene.h"

namespace kaustik::reference {

inline constexpr const char* kOtherClass = "other";
inline constexpr int kMaximumClasses = 64;

// The class of paths `name`, as the layer of an image is called.
struct PathClass {
    std::string name;
    std::string pattern;
    friend bool operator==(const PathClass&, const PathClass&) = default;
};

// A path that has arrived, by what classes are told apart by.
struct ArrivedPath {
    PathWord word;  // of a longer path the first interactions
    int interactions = 0;
    std::uint32_t firstObject = 0;  // of the scene
    // Reflected at least once at an interface that refracts light as well: neither a mirror nor
    // total.
    bool partlyReflected = false;
    friend bool operator==(const ArrivedPath&, const ArrivedPath&) = default;
};

// A class as it is asked for: PATTERN, or NAME=PATTERN. Without a name it is called as its pattern
// is without blanks: "TR+T", "TT@ball". Throws ConfigError, which begins with `place`.
[[nodiscard]] PathClass pathClassOf(const std::string& text, const std::string& place);

// Throws ConfigError where two have one name, there are more than kMaximumClasses, a name is one of
// the file's own, or an object is not in the scene or is not specular.
void requireClasses(const std::vector<PathClass>& classes, const scene::Scene& scene,
                    const std::string& place);

// The name of an object within that of a layer, where a period would begin a channel.
[[nodiscard]] std::string layerName(const std::string& text);

// Tells the classes of paths; one a thread, since it remembers what it has told.
class PathClassifier {
  public:
    // The patterns are right already. `scene` must outlive this.
    PathClassifier(const scene::Scene& scene, const std::vector<PathClass>& classes);

    // The place of the path's class among them; their number: it is of none.
    [[nodiscard]] std::size_t classOf(const ArrivedPath& path);

  private:
    [[nodiscard]] std::size_t findClass(const ArrivedPath& path) const;

    struct Known {
        ArrivedPath path;
        std::size_t place = 0;
        bool isThere = false;
    };
    const scene::Scene& scene_;
    std::vector<PathPattern> patterns_;
    std::array<Known, 512> known_{};
};

// What a class of a reference has found.
struct ClassImages {
    std::string name;
    std::string pattern;    // "" of `other`
    Image irradiance;       // W/m², as Reference::irradiance, of which it is a part
    Image irradianceError;  // standard error, the same unit
};

}  // namespace kaustik::reference
