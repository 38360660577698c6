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
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace kaustik::params {

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

    // "float", "int", "bool", "WxH" or "choice".
    [[nodiscard]] std::string typeName() const;
    // "[0.1, 8]", "a | b"; "" where everything of the type is allowed.
    [[nodiscard]] std::string rangeText() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] nlohmann::json json() const;
    // Parses and range-checks; throws ConfigError. `fullName` and `where` ("--set", "file:12") go
    // into the message. The value is unchanged when it throws.
    void set(std::string_view text, std::string_view fullName, std::string_view where) const;
};

// The visitor that `reflect` is called with.
class FieldList {
  public:
    void field(float& value, std::string name, std::string sentence, std::string unit,
               Range<float> allowed);
    void field(int& value, std::string name, std::string sentence, std::string unit,
               Range<int> allowed);
    void field(bool& value, std::string name, std::string sentence);
    void field(Extent& value, std::string name, std::string sentence, std::string unit,
               Range<int> allowedSide);
    // Enum must be an int-backed enum whose values index `names`; a value that has none is a
    // ConfigError.
    template <class Enum>
    void choice(Enum& value, std::string name, std::string sentence,
                std::initializer_list<const char*> names) {
        static_assert(std::is_enum_v<Enum> && std::is_same_v<std::underlying_type_t<Enum>, int>,
                      "a choice is an enum class with underlying type int");
        addChoice(reinterpret_cast<int&>(value), std::move(name), std::move(sentence),
                  {names.begin(), names.end()});
    }
    void addChoice(int& index, std::string name, std::string sentence,
                   std::vector<std::string> names);

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

// For nodes without parameters.
struct NoParams {
    template <class R>
    void reflect(R&) {}
};

}  // namespace kaustik::params
