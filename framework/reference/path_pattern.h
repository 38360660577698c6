// SPDX-License-Identifier: MIT
// Regular expressions over paths of light (Heckbert 1990, "Adaptive radiosity textures for
// bidirectional ray tracing", section 2), which select classes of caustic paths: `L T T D`, or
// `L T R+ T D @ball`.
//
//   pattern  = [L] choice [D] [@ object]     blanks do not count
//   choice   = sequence { | sequence }
//   sequence = item { item }
//   item     = atom [ + | * | ? | {n} | {n,} | {n,m} ]
//   atom     = T | R | S | ( choice )
//
// T is a refraction through an interface, R a reflection, at a mirror or an interface and total
// ones too, S either of them. L, the light, and D, the receiver, are at the ends of every path
// here. The object is the first specular one on the way, by its name in the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kaustik::reference {

// The interactions of a path, the first in the lowest bit; set where it was a reflection.
struct PathWord {
    std::uint64_t reflections = 0;
    int length = 0;
    friend bool operator==(const PathWord&, const PathWord&) = default;
};
inline constexpr int kLongestPathWord = 64;

// "TRT" for a refraction, a reflection and a refraction.
[[nodiscard]] std::string textOf(const PathWord& word);

class PathPattern {
  public:
    // Throws ConfigError, which begins with `place` ("--class"), for what is no pattern.
    PathPattern(const std::string& text, const std::string& place);

    // All of the word; the object is not asked for.
    [[nodiscard]] bool matches(const PathWord& word) const;
    // The pattern without blanks, ends and object: "TR+T".
    [[nodiscard]] const std::string& text() const { return text_; }
    // "" where any will do.
    [[nodiscard]] const std::string& object() const { return object_; }

  private:
    // A state of the automaton (Thompson 1968): takes one interaction and goes on to the next
    // state, or takes none and goes on to one or two others.
    struct State {
        bool takesRefraction = false;
        bool takesReflection = false;
        int next = -1;  // -1: the end
        int other = -1;
        bool isFork = false;
    };
    struct Parser;
    void enter(int state, std::vector<bool>& active) const;

    std::string text_;
    std::string object_;
    std::vector<State> states_;
    int start_ = 0;
};

}  // namespace kaustik::reference
