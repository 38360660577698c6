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

// How far the parser is in the text.
struct Progress {
    std::size_t line = 1;
    char last = '\0';
};

// Keeps it while the parser goes on.
class LineCounter {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    LineCounter(const char* at, Progress& progress) : at_(at), progress_(&progress) {}
    reference operator*() const { return *at_; }
    LineCounter& operator++() {
        progress_->last = *at_;
        if (*at_ == '\n') ++progress_->line;
        ++at_;
        return *this;
    }
    LineCounter operator++(int) {
        const LineCounter before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(const LineCounter& a, const LineCounter& b) { return a.at_ == b.at_; }

  private:
    const char* at_;
    Progress* progress_;
};

class TreeBuilder : public nlohmann::json_sax<json> {
  public:
    TreeBuilder(std::string file, const Progress& progress)
        : file_(std::move(file)), progress_(progress) {}

    bool null() override { return add(std::monostate()); }
    bool boolean(bool flag) override { return add(flag); }
    bool number_integer(number_integer_t number) override {
        return addNumber(static_cast<double>(number));
    }
    bool number_unsigned(number_unsigned_t number) override {
        return addNumber(static_cast<double>(number));
    }
    bool number_float(number_float_t number, const string_t&) override { return addNumber(number); }
    bool string(string_t& text) override { return add(text); }
    bool binary(binary_t&) override { return false; }  // JSON as text has none
    bool start_object(std::size_t) override { return open(JsonTree::Object()); }
    bool start_array(std::size_t) override { return open(JsonTree::List()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        auto& object = std::get<JsonTree::Object>(path_.back()->value);
        object.push_back({name, JsonTree{{}, place()}});
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
    [[nodiscard]] std::string place() const { return fmt::format("{}:{}", file_, progress_.line); }
    // A number ends where the next character is none of it, and that may be on the next line.
    [[nodiscard]] std::string placeOfNumber() const {
        return fmt::format("{}:{}", file_, progress_.line - (progress_.last == '\n' ? 1 : 0));
    }

    // Where the next value goes.
    JsonTree& next() {
        if (path_.empty()) {
            root.place = place();
            return root;
        }
        if (auto* const list = std::get_if<JsonTree::List>(&path_.back()->value))
            return list->emplace_back(JsonTree{{}, place()});
        return std::get<JsonTree::Object>(path_.back()->value).back().node;
    }

    bool addNumber(double number) {
        JsonTree& node = next();
        node.value = number;
        const bool isOfKey = !path_.empty() && path_.back()->as<JsonTree::Object>() != nullptr;
        if (!isOfKey) node.place = placeOfNumber();
        return true;
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
    const Progress& progress_;
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
    Progress progress;
    TreeBuilder builder(file.string(), progress);
    json::sax_parse(LineCounter(text.data(), progress),
                    LineCounter(text.data() + text.size(), progress), &builder);
    return std::move(builder.root);
}

}  // namespace kaustik::scene
