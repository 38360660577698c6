// SPDX-License-Identifier: MIT
// Lines of a scene file: keys with their values, names quoted, numbers in few digits.
#pragma once

#include <glm/glm.hpp>
#include <set>
#include <string>
#include <string_view>

namespace kaustik::scene {

// On one line and valid UTF-8, whatever the foreign file had in it: for comments and for names.
[[nodiscard]] std::string oneLine(const std::string& text);

// The name, or with a number behind it where it is taken; and takes it.
[[nodiscard]] std::string takeName(const std::string& name, std::set<std::string>& taken);

// Six digits; a place, which may be far from the origin, has eight.
[[nodiscard]] std::string fewDigits(double number);

class TomlLines {
  public:
    void comment(const std::string& text);
    void blank() { text_ += '\n'; }
    void table(std::string_view head);  // "[camera]"
    void set(std::string_view key, const std::string& value);
    void set(std::string_view key, const char* value) { set(key, std::string(value)); }
    void set(std::string_view key, double value);
    void set(std::string_view key, bool value);
    void set(std::string_view key, const glm::dvec2& value);
    void set(std::string_view key, const glm::dvec3& value);
    // One number where all three are the same.
    void setColor(std::string_view key, const glm::dvec3& value);
    // Only what is not the default.
    void setUnless(const glm::dvec3& otherwise, std::string_view key, const glm::dvec3& value);

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    void line(std::string_view key, const std::string& value);
    void setThree(std::string_view key, const glm::dvec3& value, int digits);
    std::string text_;
};

}  // namespace kaustik::scene
