// SPDX-License-Identifier: MIT
#include "framework/reference/path_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <memory>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::reference {
namespace {

constexpr int kMaximumRepeats = kLongestPathWord;
constexpr int kUnlimited = -1;
// No pattern that anybody writes has so many; repeats within repeats soon do.
constexpr std::size_t kMaximumStates = 4096;
constexpr int kMaximumDepth = 64;

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::string textOf(const PathWord& word) {
    std::string text;
    for (int i = 0; i < word.length; ++i)
        text += (word.reflections >> i & 1) != 0 ? 'R' : 'T';
    return text;
}

// Builds states from the end: each piece is told which state comes after it, and gives the one
// that it begins with. A piece that repeats is read once and built as often as it may be needed.
struct PathPattern::Parser {
    struct Node;
    using NodePtr = std::shared_ptr<Node>;
    struct Node {
        enum class Kind { interaction, sequence, choice, repeat } kind = Kind::sequence;
        char letter = 'S';
        std::vector<NodePtr> parts;
        int minimum = 1;
        int maximum = 1;
    };

    PathPattern& pattern;
    const std::string& all;  // as it was given, for messages
    const std::string& place;
    std::size_t at = 0;
    int depth = 0;

    [[noreturn]] void fail(const std::string& what) const {
        throw ConfigError(fmt::format("{}: '{}' is no class of paths: {}.", place, all, what));
    }
    [[nodiscard]] bool isAt(char c) const { return at < text().size() && text()[at] == c; }
    [[nodiscard]] const std::string& text() const { return pattern.text_; }

    NodePtr choice() {
        if (++depth > kMaximumDepth) fail("its brackets are too deep");
        auto node = std::make_shared<Node>();
        node->kind = Node::Kind::choice;
        node->parts.push_back(sequence());
        while (isAt('|')) {
            ++at;
            node->parts.push_back(sequence());
        }
        --depth;
        return node;
    }

    NodePtr sequence() {
        auto node = std::make_shared<Node>();
        while (at < text().size() && !isAt('|') && !isAt(')'))
            node->parts.push_back(item());
        if (node->parts.empty()) fail("it has a part without an interaction, T, R or S");
        return node;
    }

    NodePtr item() {
        NodePtr node = atom();
        if (at >= text().size()) return node;
        int minimum = 1;
        int maximum = 1;
        switch (text()[at]) {
            case '+':
                maximum = kUnlimited;
                break;
            case '*':
                minimum = 0;
                maximum = kUnlimited;
                break;
            case '?':
                minimum = 0;
                break;
            case '{':
                readCounts(minimum, maximum);
                break;
            default:
                return node;
        }
        ++at;
        if (at < text().size() && std::string("+*?{").find(text()[at]) != std::string::npos)
            fail(fmt::format("there are two repeats, the second '{}'", text()[at]));
        auto repeated = std::make_shared<Node>();
        repeated->kind = Node::Kind::repeat;
        repeated->parts.push_back(std::move(node));
        repeated->minimum = minimum;
        repeated->maximum = maximum;
        return repeated;
    }

    NodePtr atom() {
        const char c = text()[at];
        if (c == '(') {
            ++at;
            NodePtr node = choice();
            if (!isAt(')')) fail("a '(' is not closed");
            ++at;
            return node;
        }
        if (std::string("+*?{").find(c) != std::string::npos)
            fail(fmt::format("'{}' has nothing before it to repeat", c));
        if (c != 'T' && c != 'R' && c != 'S') {
            fail(fmt::format(
                "'{}' is no interaction; T (refracted), R (reflected) and S (either) are", c));
        }
        ++at;
        auto node = std::make_shared<Node>();
        node->kind = Node::Kind::interaction;
        node->letter = c;
        return node;
    }

    // {n}, {n,} or {n,m}; stays at the last brace.
    void readCounts(int& minimum, int& maximum) {
        const auto number = [&] {
            int value = 0;
            bool isThere = false;
            for (; at < text().size() && std::isdigit(static_cast<unsigned char>(text()[at])) != 0;
                 ++at) {
                value = std::min(10 * value + (text()[at] - '0'), kMaximumRepeats + 1);
                isThere = true;
            }
            return isThere ? value : kUnlimited;
        };
        ++at;
        minimum = number();
        maximum = minimum;
        if (isAt(',')) {
            ++at;
            maximum = number();
        }
        if (minimum == kUnlimited || !isAt('}')) fail("a '{' needs {n}, {n,} or {n,m}");
        if (minimum > kMaximumRepeats || maximum > kMaximumRepeats || maximum == 0)
            fail(fmt::format("repeats are from 1 to {}", kMaximumRepeats));
        if (maximum != kUnlimited && maximum < minimum)
            fail(fmt::format("it repeats at least {} and at most {} times", minimum, maximum));
    }

    int add(const State& state) {
        if (pattern.states_.size() >= kMaximumStates) fail("it repeats too much within repeats");
        pattern.states_.push_back(state);
        return static_cast<int>(pattern.states_.size()) - 1;
    }
    int fork(int next, int other) {
        State state;
        state.isFork = true;
        state.next = next;
        state.other = other;
        return add(state);
    }

    int build(const Node& node, int after) {
        switch (node.kind) {
            case Node::Kind::interaction: {
                State state;
                state.takesRefraction = node.letter != 'R';
                state.takesReflection = node.letter != 'T';
                state.next = after;
                return add(state);
            }
            case Node::Kind::sequence:
                for (std::size_t i = node.parts.size(); i > 0; --i)
                    after = build(*node.parts[i - 1], after);
                return after;
            case Node::Kind::choice: {
                int first = build(*node.parts.back(), after);
                for (std::size_t i = node.parts.size() - 1; i > 0; --i)
                    first = fork(build(*node.parts[i - 1], after), first);
                return first;
            }
            case Node::Kind::repeat:
                return buildRepeat(node, after);
        }
        return after;
    }

    int buildRepeat(const Node& node, int after) {
        const Node& part = *node.parts.front();
        if (node.maximum == kUnlimited) {
            // The fork comes back after each time round.
            const int loop = fork(-1, after);
            const int body = build(part, loop);
            pattern.states_[static_cast<std::size_t>(loop)].next = body;
            after = loop;
        } else {
            const int end = after;
            for (int i = node.minimum; i < node.maximum; ++i)
                after = fork(build(part, after), end);
        }
        for (int i = 0; i < node.minimum; ++i)
            after = build(part, after);
        return after;
    }
};

PathPattern::PathPattern(const std::string& text, const std::string& place) {
    const std::size_t mark = text.find('@');
    const std::string path = text.substr(0, mark);
    for (const char c : path) {
        if (std::isspace(static_cast<unsigned char>(c)) == 0) text_ += c;
    }
    Parser parser{*this, text, place};
    if (mark != std::string::npos) {
        object_ = trimmed(text.substr(mark + 1));
        if (object_.empty()) parser.fail("no object is named after '@'");
    }
    if (text_.starts_with('L')) text_.erase(0, 1);
    if (text_.ends_with('D')) text_.pop_back();
    if (text_.empty()) parser.fail("it names no interaction, T, R or S");
    const Parser::NodePtr root = parser.choice();
    if (parser.at != text_.size()) parser.fail("a ')' has no '(' before it");
    // The end is the state 0, which takes nothing.
    states_.push_back({});
    start_ = parser.build(*root, 0);
}

void PathPattern::enter(int state, std::vector<bool>& active) const {
    std::vector<int> waiting{state};
    while (!waiting.empty()) {
        const auto at = static_cast<std::size_t>(waiting.back());
        waiting.pop_back();
        if (active[at]) continue;
        active[at] = true;
        if (!states_[at].isFork) continue;
        waiting.push_back(states_[at].next);
        waiting.push_back(states_[at].other);
    }
}

bool PathPattern::matches(const PathWord& word) const {
    std::vector<bool> active(states_.size());
    enter(start_, active);
    for (int i = 0; i < word.length; ++i) {
        const bool isReflected = (word.reflections >> i & 1) != 0;
        std::vector<bool> then(states_.size());
        for (std::size_t at = 0; at < states_.size(); ++at) {
            const State& state = states_[at];
            if (!active[at] || state.isFork) continue;
            if (isReflected ? state.takesReflection : state.takesRefraction)
                enter(state.next, then);
        }
        active = std::move(then);
    }
    return active[0];
}

}  // namespace kaustik::reference
