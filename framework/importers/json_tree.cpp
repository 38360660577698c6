// SPDX-License-Identifier: MIT
#include "framework/importers/json_tree.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "framework/core/files.h"
#include "framework/importers/foreign_values.h"

namespace kaustik::scene {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxJsonDepth = 64;

// Counts lines while the parser goes through the text.
class LineCounter {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    LineCounter(const char* at, std::size_t& line) : at_(at), line_(&line) {}
    reference operator*() const { return *at_; }
    LineCounter& operator++() {
        if (*at_ == '\n') ++*line_;
        ++at_;
        return *this;
    }
    LineCounter operator++(int) {
        const LineCounter before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(const LineCounter& a, const LineCounter& b) { return a.at_ == b.at_; }
    friend bool operator!=(const LineCounter& a, const LineCounter& b) { return a.at_ != b.at_; }

  private:
    const char* at_;
    std::size_t* line_;
};

class TreeBuilder : public nlohmann::json_sax<json> {
  public:
    TreeBuilder(std::string file, const std::size_t& line) : file_(std::move(file)), line_(line) {}

    bool null() override { return add(std::monostate()); }
    bool boolean(bool flag) override { return add(flag); }
    bool number_integer(number_integer_t number) override {
        return add(static_cast<double>(number));
    }
    bool number_unsigned(number_unsigned_t number) override {
        return add(static_cast<double>(number));
    }
    bool number_float(number_float_t number, const string_t&) override { return add(number); }
    bool string(string_t& text) override { return add(text); }
    bool binary(binary_t&) override { return false; }  // JSON as text has none
    bool start_object(std::size_t) override { return open(JsonTree::Object()); }
    bool start_array(std::size_t) override { return open(JsonTree::List()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        auto& object = std::get<JsonTree::Object>(path_.back()->value);
        object.emplace_back(name, JsonTree{{}, place()});
        return true;
    }
    bool parse_error(std::size_t, const std::string&,
                     const nlohmann::detail::exception& error) override {
        // "[json.exception.…] parse error at line 3, column 1: syntax error while …"
        const std::string text = error.what();
        const std::size_t reason = text.find("column");
        const std::size_t colon = text.find(": ", reason == std::string::npos ? 0 : reason);
        failAt(place(), fmt::format("This is not valid JSON: {}.",
                                    colon == std::string::npos ? text : text.substr(colon + 2)));
    }
    JsonTree root;

  private:
    [[nodiscard]] std::string place() const { return fmt::format("{}:{}", file_, line_); }

    // Where the next value goes.
    JsonTree& next() {
        if (path_.empty()) {
            root.place = place();
            return root;
        }
        if (auto* const list = std::get_if<JsonTree::List>(&path_.back()->value))
            return list->emplace_back(JsonTree{{}, place()});
        return std::get<JsonTree::Object>(path_.back()->value).back().second;
    }

    template <class T>
    bool add(T value) {
        next().value = std::move(value);
        return true;
    }

    template <class T>
    bool open(T container) {
        if (path_.size() >= kMaxJsonDepth)
            failAt(place(), fmt::format("This is nested more than {} deep.", kMaxJsonDepth));
        JsonTree& node = next();
        node.value = std::move(container);
        path_.push_back(&node);
        return true;
    }

    bool close() {
        path_.pop_back();
        return true;
    }

    std::string file_;
    const std::size_t& line_;
    std::vector<JsonTree*> path_;  // only the last of a list or object grows
};

}  // namespace

const JsonTree* JsonTree::find(std::string_view key) const {
    const auto* const object = as<Object>();
    if (object == nullptr) return nullptr;
    for (const auto& [name, node] : *object) {
        if (name != key) continue;
        node.isUsed = true;
        return &node;
    }
    return nullptr;
}

void JsonTree::markUsed() const {
    isUsed = true;
    if (const auto* const list = as<List>()) {
        for (const JsonTree& node : *list)
            node.markUsed();
    }
    if (const auto* const object = as<Object>()) {
        for (const auto& [name, node] : *object)
            node.markUsed();
    }
}

JsonTree readJsonTree(const std::filesystem::path& file) {
    const std::string text = readFile(file);
    std::size_t line = 1;
    TreeBuilder builder(file.string(), line);
    json::sax_parse(LineCounter(text.data(), line), LineCounter(text.data() + text.size(), line),
                    &builder);
    return std::move(builder.root);
}

}  // namespace kaustik::scene
