// SPDX-License-Identifier: MIT
// A parameter is declared once, in its struct's `reflect`, with a name, a sentence, a unit, a range
// and a default; the command line, experiment files, the report, the GUI and the shader constants
// all read that one line (framework/README.md, "Parameters"):
//
//     struct TraceParams {
//         float epsilonMeters = 0.01f;
//         template <class R> void reflect(R& r) {
//             r.field(epsilonMeters, "epsilon", "Largest distance that counts as a hit", "m",
//                     range(1e-6f, 1.0f));
//         }
//     };
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace kaustik {
// What is known of a frame before it is built; whoever builds frames defines it
// (framework/pipeline/effect.h).
struct FrameFacts;
}  // namespace kaustik

namespace kaustik::params {

// Why a parameter has no effect, as the end of a sentence: "with trace.test=crossing", or a clause
// of its own, "no receiver is glossy". "" where it has an effect, or may have one.
using Condition = std::function<std::string(const FrameFacts&)>;

// A grid size, written WxH.
struct Extent {
    int width = 0;
    int height = 0;
    friend bool operator==(const Extent&, const Extent&) = default;
};

template <class T>
struct Range {
    T minimum;
    T maximum;
};

template <class T>
[[nodiscard]] constexpr Range<T> range(T minimum, T maximum) {
    return {minimum, maximum};
}

// One of a list of names; `index` points into it. Enums are declared with FieldList::choice.
struct ChoiceRef {
    int* index = nullptr;
};

// One declared parameter and the place that holds its value. The place must outlive the field.
struct Field {
    std::string name;  // within its scope, e.g. "epsilon"
    std::string sentence;
    std::string unit;  // "" for none
    std::variant<bool*, int*, float*, Extent*, ChoiceRef> target;
    double minimum = 0.0;  // numbers and extents (each side)
    double maximum = 0.0;
    std::vector<std::string> choices;
    std::vector<int> values = {};  // the only ones that an int takes; empty: all of its range
    std::string formerName{};      // within its scope; "" where it was never called otherwise
    std::vector<Condition> conditions = {};
    std::string obstacle = {};  // as a Condition says it, by other values of the same struct

    // Says when the parameter has an effect, right after its declaration; all that is said must
    // hold. By the frame's settings and what its scene needs:
    //     r.field(…).when([](const FrameFacts& facts) { … return ""; });
    // and by other values of the same struct:
    //     r.field(…).when(radiusMeters <= 0.0f, "its radius is set");
    Field& when(Condition whyNoEffect);
    Field& when(bool hasEffect, const std::string& otherwise);

    // Of an int: these values alone, in ascending order, and what lies between them is refused.
    Field& only(std::vector<int> values);

    // "float", "int", "bool", "WxH" or "choice".
    [[nodiscard]] std::string typeName() const;
    // "0.1 to 8", "1x1 to 64x64", "a | b", "true | false", "1 | 4 | 9".
    [[nodiscard]] std::string rangeText() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] nlohmann::json json() const;
    // Parses and range-checks; throws ConfigError. `fullName` and `where` ("--set", "file:12") go
    // into the message. The value is unchanged when it throws.
    void set(std::string_view text, std::string_view fullName, std::string_view where) const;
};

// The visitor that `reflect` is called with. The field that it gives back is there until the next.
class FieldList {
  public:
    Field& field(float& value, std::string name, std::string sentence, std::string unit,
                 Range<float> allowed);
    Field& field(int& value, std::string name, std::string sentence, std::string unit,
                 Range<int> allowed);
    Field& field(bool& value, std::string name, std::string sentence);
    Field& field(Extent& value, std::string name, std::string sentence, std::string unit,
                 Range<int> allowedSide);
    // Enum must be an int-backed enum whose values index `names`; a value that has none is a
    // ConfigError.
    template <class Enum>
    Field& choice(Enum& value, std::string name, std::string sentence,
                  std::initializer_list<const char*> names) {
        static_assert(std::is_enum_v<Enum> && std::is_same_v<std::underlying_type_t<Enum>, int>,
                      "a choice is an enum class with underlying type int");
        return addChoice(reinterpret_cast<int&>(value), std::move(name), std::move(sentence),
                         {names.begin(), names.end()});
    }
    Field& addChoice(int& index, std::string name, std::string sentence,
                     std::vector<std::string> names);

    // Says that the parameter `name`, which has been declared, was called `formerName` before: who
    // still uses that name gets an error with the new one.
    void renamed(std::string_view formerName, std::string_view name);

    [[nodiscard]] std::vector<Field>& fields() { return fields_; }

  private:
    std::vector<Field> fields_;
};

// The fields of a parameter struct, pointing into it.
template <class Params>
[[nodiscard]] std::vector<Field> fieldsOf(Params& params) {
    FieldList list;
    params.reflect(list);
    return std::move(list.fields());
}

// The parameter struct of nodes that have no parameters.
struct NoParams {
    template <class R>
    void reflect(R&) {}
};

}  // namespace kaustik::params
