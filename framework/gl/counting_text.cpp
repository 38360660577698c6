// SPDX-License-Identifier: MIT
#include "framework/gl/counting_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <set>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::gl {
namespace {

// How something is accessed: bits, as the shaders have them.
constexpr int kReads = 1;
constexpr int kWrites = 2;
constexpr int kAtomic = 4;

// Functions that stand before everything else. `countedShape`: width, height and layers in texels
// and bytes a texel, or the bytes of a buffer; `countedFirst`: the word of `countedBits` at which
// the bits of what is read and of what is written begin, all ones where nothing is bound.
constexpr const char* kPrelude = R"glsl(
uniform uvec4 countedShape[{numbers}];
uniform uvec2 countedFirst[{numbers}];
uniform int countedTargetLayer;
uniform int countedTargetUse;
layout(std430) buffer CountedAccesses {{
    uint countedTotals[{totals}];
    uint countedBits[];
}};
uvec4 countedHere = uvec4(0u, 0u, 0u, 1u);

// One atomic and no loop: compilers put this in the place of every access.
void countedMark(uint at, uint first, uint count) {{
    uint mask = (count >= 32u ? 0xffffffffu : (1u << count) - 1u) << (first & 31u);
    if (at != 0xffffffffu) atomicOr(countedBits[at + (first >> 5u)], mask);
}}

void countedAccess(int what, int use, uint first, uint count, uint bytes) {{
    if ((use & {atomic}) != 0) {{
        ++countedHere.z;
    }} else {{
        if ((use & {reads}) != 0) countedHere.x += bytes;
        if ((use & {writes}) != 0) countedHere.y += bytes;
    }}
    if ((use & {reads}) != 0) countedMark(countedFirst[what].x, first, count);
    if ((use & {writes}) != 0) countedMark(countedFirst[what].y, first, count);
}}

ivec3 countedTexel(int what, int use, ivec3 texel) {{
    uvec4 shape = countedShape[what];
    if (all(lessThan(uvec3(texel), shape.xyz))) {{
        uint first = (uint(texel.z) * shape.y + uint(texel.y)) * shape.x + uint(texel.x);
        countedAccess(what, use, first, 1u, shape.w);
    }}
    return texel;
}}
ivec2 countedTexel(int what, int use, ivec2 texel) {{
    countedTexel(what, use, ivec3(texel, 0));
    return texel;
}}

vec3 countedSample(int what, vec3 place) {{
    uvec4 shape = countedShape[what];
    vec3 texel = vec3(fract(place.xy) * vec2(shape.xy), place.z + 0.5);
    countedTexel(what, {reads}, min(ivec3(texel), ivec3(shape.xyz) - 1));
    return place;
}}
vec2 countedSample(int what, vec2 place) {{
    countedSample(what, vec3(place, 0.0));
    return place;
}}

// `bytes` of an element that lies at `offset` in each `stride` of an array.
uint countedElement(int what, int use, uint stride, uint offset, uint bytes, uint index) {{
    uint first = index * stride + offset;
    uint last = first + bytes - 1u;
    if (last < countedShape[what].x)
        countedAccess(what, use, first / {piece}u, last / {piece}u - first / {piece}u + 1u, bytes);
    return index;
}}
int countedElement(int what, int use, uint stride, uint offset, uint bytes, int index) {{
    countedElement(what, use, stride, offset, bytes, uint(index));
    return index;
}}

// Of a buffer's texels, whose bytes its shape has next to its own.
int countedTexel(int what, int use, int texel) {{
    uint bytes = countedShape[what].y;
    return countedElement(what, use, bytes, 0u, bytes, texel);
}}

// For atomics on what is in no array: of what is added.
uint countedOperand(int what, uint offset, uint operand) {{
    countedAccess(what, {atomic} | {reads} | {writes}, offset / {piece}u, 1u, 4u);
    return operand;
}}

void countedFlush(uint thread) {{
    uint shard = 4u * (thread % {shards}u);
    for (int i = 0; i < 4; ++i)
        if (countedHere[i] != 0u) atomicAdd(countedTotals[shard + uint(i)], countedHere[i]);
}}
)glsl";

constexpr const char* kFragmentPrelude = R"glsl(
uint countedThread() {
    return uint(gl_FragCoord.x) + 61u * uint(gl_FragCoord.y);
}
void countedTargets(int layer) {
    ivec3 texel = ivec3(ivec2(gl_FragCoord.xy), layer);
    for (int i = 0; i < kCountedOutputs; ++i) countedTexel(48 + i, countedTargetUse, texel);
    if (countedShape[56].x > 0u) countedTexel(56, 3, texel);
}
)glsl";

std::string prelude() {
    using namespace fmt::literals;
    return fmt::format(fmt::runtime(kPrelude), "numbers"_a = kCountedNumbers,
                       "totals"_a = 4 * kCountedShards, "shards"_a = kCountedShards,
                       "piece"_a = kCountedPiece, "reads"_a = kReads, "writes"_a = kWrites,
                       "atomic"_a = kAtomic);
}

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Comments become spaces, so that all places stay what they were.
std::string withoutComments(std::string text) {
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] != '/') continue;
        if (text[i + 1] == '/') {
            while (i < text.size() && text[i] != '\n')
                text[i++] = ' ';
        } else if (text[i + 1] == '*') {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
            for (; i < end; ++i) {
                if (text[i] != '\n') text[i] = ' ';
            }
        }
    }
    return text;
}

int sizeOf(const BlockVariable& variable) {
    return variable.elements <= 1 ? variable.bytes
                                  : (variable.elements - 1) * variable.stride + variable.bytes;
}

class Counting {
  public:
    Counting(std::string text, const BlockLayout& layout, std::vector<std::string>& names)
        : text_(withoutComments(std::move(text))), layout_(layout), names_(names) {
        findDeclarations();
    }

    // Everything but main().
    std::string run() {
        for (std::size_t at = 0; at < text_.size();) {
            if (text_[at] == '#' && isFirstOfLine(at)) {
                at = text_.find('\n', at);
                if (at == std::string::npos) break;
                continue;
            }
            if (!isWordCharacter(text_[at])) {
                if (text_[at] == '{') ++depth_;
                if (text_[at] == '}') {
                    --depth_;
                    std::erase_if(locals_, [&](const auto& l) { return l.second > depth_; });
                }
                ++at;
                continue;
            }
            const std::size_t end = wordEnd(at);
            if (text_.compare(at, end - at, "buffer") == 0) {  // what follows declares, not uses
                at = text_.find('}', end) + 1;
                continue;
            }
            visit(text_.substr(at, end - at), at, end);
            at = end;
        }
        std::stable_sort(insertions_.begin(), insertions_.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::string result;
        std::size_t done = 0;
        for (const auto& [place, inserted] : insertions_) {
            result.append(text_, done, place - done);
            result += inserted;
            done = place;
        }
        return result + text_.substr(done);
    }

    [[nodiscard]] bool stores() const { return stores_; }

  private:
    void findDeclarations() {
        static const std::regex opaque(
            R"rx(\buniform\s+(?:\w+\s+)*?[iu]?(?:(?:sampler|image)2D(?:Array)?|samplerBuffer)\s+(\w+)\s*;)rx");
        for (std::sregex_iterator i(text_.begin(), text_.end(), opaque), end; i != end; ++i)
            opaque_.insert((*i)[1].str());
        for (const auto& [name, variable] : layout_)
            members_.insert(name.substr(0, name.find_first_of("[.")));
    }

    [[nodiscard]] std::size_t wordEnd(std::size_t at) const {
        while (at < text_.size() && isWordCharacter(text_[at]))
            ++at;
        return at;
    }
    [[nodiscard]] std::size_t skipSpace(std::size_t at) const {
        while (at < text_.size() && std::isspace(static_cast<unsigned char>(text_[at])) != 0)
            ++at;
        return at;
    }
    // The last character before `at` that is no space; npos where there is none.
    [[nodiscard]] std::size_t before(std::size_t at) const {
        while (at > 0) {
            if (std::isspace(static_cast<unsigned char>(text_[--at])) == 0) return at;
        }
        return std::string::npos;
    }
    [[nodiscard]] bool isFirstOfLine(std::size_t at) const {
        while (at > 0 && (text_[at - 1] == ' ' || text_[at - 1] == '\t'))
            --at;
        return at == 0 || text_[at - 1] == '\n';
    }
    // Where the brackets that open at `at` close, or, outside of inner ones, a comma stands.
    [[nodiscard]] std::size_t closing(std::size_t at, bool orComma = false) const {
        int depth = 0;
        for (std::size_t i = at; i < text_.size(); ++i) {
            const char c = text_[i];
            if (c == '(' || c == '[' || c == '{') ++depth;
            if (c == ')' || c == ']' || c == '}') --depth;
            if (depth == 0 || (orComma && depth == 1 && c == ',')) return i;
        }
        return text_.size();
    }
    int number(const std::string& name) {
        const auto known = std::find(names_.begin(), names_.end(), name);
        if (known != names_.end()) return static_cast<int>(known - names_.begin());
        if (names_.size() == static_cast<std::size_t>(kCountedNames)) {
            throw ShaderError(
                fmt::format("A program accesses more than {} textures, images and "
                            "blocks; their accesses cannot be counted.",
                            kCountedNames));
        }
        names_.push_back(name);
        return static_cast<int>(names_.size()) - 1;
    }
    void insert(std::size_t at, std::string text) { insertions_.emplace_back(at, std::move(text)); }

    void visit(const std::string& word, std::size_t at, std::size_t end) {
        const std::size_t previous = before(at);
        if (previous != std::string::npos && text_[previous] == '.') return;
        if (previous != std::string::npos && isWordCharacter(text_[previous]) &&
            members_.contains(word) && !isKeyword(previous)) {
            // A variable or parameter of a function's own, which hides the block's.
            locals_.emplace(word, std::max(depth_, 1));
            return;
        }
        if (locals_.contains(word)) return;
        if (word == "discard") {
            insert(at, "{ countedFlush(countedThread()); ");
            insert(text_.find(';', end) + 1, " }");
            return;
        }
        const std::size_t open = skipSpace(end);
        if (open < text_.size() && text_[open] == '(') return visitCall(word, open);
        if (members_.contains(word)) visitMember(word, at, end);
    }

    // Whether the word that ends there is one that an expression may follow.
    [[nodiscard]] bool isKeyword(std::size_t last) const {
        std::size_t first = last;
        while (first > 0 && isWordCharacter(text_[first - 1]))
            --first;
        const std::string word = text_.substr(first, last + 1 - first);
        return word == "return" || word == "else" || word == "case";
    }

    // texelFetch(NAME, texel, …): the second argument passes through a function that counts it.
    void visitCall(const std::string& function, std::size_t open) {
        int use = kReads;
        bool isSample = false;
        if (function == "texture" || function == "textureLod" || function == "textureGrad") {
            isSample = true;
        } else if (function == "imageStore") {
            use = kWrites;
        } else if (function.starts_with("imageAtomic")) {
            use = kAtomic | kReads | kWrites;
        } else if (function != "texelFetch" && function != "imageLoad") {
            return;
        }
        const std::size_t begin = skipSpace(open + 1);
        const std::size_t end = wordEnd(begin);
        const std::string name = text_.substr(begin, end - begin);
        const std::size_t comma = skipSpace(end);
        if (!opaque_.contains(name) || text_[comma] != ',') {
            throw ShaderError(fmt::format(
                "{}({}…) names no sampler or image of its own shader; its accesses cannot be "
                "counted.",
                function, name));
        }
        if ((use & kWrites) != 0) stores_ = true;
        const std::string call = isSample ? fmt::format(" countedSample({},", number(name))
                                          : fmt::format(" countedTexel({}, {},", number(name), use);
        insert(comma + 1, call);
        insert(argumentEnd(open, comma), ")");
    }

    // Of the argument that begins behind a comma of the call that opens at `open`.
    [[nodiscard]] std::size_t argumentEnd(std::size_t open, std::size_t comma) const {
        int depth = 0;
        for (std::size_t i = comma + 1; i < text_.size(); ++i) {
            const char c = text_[i];
            if (depth == 0 && (c == ',' || c == ')')) return i;
            if (c == '(' || c == '[') ++depth;
            if (c == ')' || c == ']') --depth;
        }
        return open;
    }

    // What of an element is accessed: bytes from an offset.
    struct Part {
        std::string block;
        int offset;
        int bytes;
        int topLevelStride;
    };
    // By the longest beginning of the chain that the driver knows.
    [[nodiscard]] std::optional<Part> partOf(const std::vector<std::string>& chain) const {
        std::string name;
        std::optional<Part> part;
        for (const std::string& link : chain) {
            name += link;
            std::optional<Part> here;
            for (const std::string& known : {name, name + "[0]"}) {
                const auto exact = layout_.find(known);
                if (exact == layout_.end()) continue;
                const BlockVariable& variable = exact->second;
                // Of an array that is indexed, one element.
                const bool isElement = known == name && name.ends_with("[0]");
                int topLevelStride = variable.topLevelStride;
                if (isElement && name.find('[') == name.size() - 3 &&
                    name.find('.') == std::string::npos)
                    topLevelStride = variable.stride;
                here = {variable.block, variable.offset,
                        isElement ? variable.bytes : sizeOf(variable), topLevelStride};
                break;
            }
            if (!here) here = wholeOf(name);
            if (!here) break;
            part = here;
        }
        return part;
    }
    // All variables below a struct.
    [[nodiscard]] std::optional<Part> wholeOf(const std::string& name) const {
        std::optional<Part> part;
        int end = 0;
        for (auto i = layout_.lower_bound(name); i != layout_.end(); ++i) {
            if (!i->first.starts_with(name)) break;
            const char next = i->first.size() > name.size() ? i->first[name.size()] : '\0';
            if (next != '.' && next != '[') continue;
            const BlockVariable& variable = i->second;
            if (!part) {
                part = {variable.block, variable.offset, 0, variable.topLevelStride};
                end = variable.offset;
            }
            part->offset = std::min(part->offset, variable.offset);
            end = std::max(end, variable.offset + sizeOf(variable));
        }
        if (part) part->bytes = end - part->offset;
        return part;
    }

    void visitMember(const std::string& member, std::size_t at, std::size_t end) {
        std::vector<std::string> chain{member};
        std::optional<std::pair<std::size_t, std::size_t>> index;  // brackets of the outermost
        std::size_t last = end;
        for (;;) {
            const std::size_t next = skipSpace(last);
            if (next >= text_.size()) break;
            if (text_[next] == '[') {
                const std::size_t close = closing(next);
                if (chain.size() == 1) index = {next, close};
                chain.emplace_back("[0]");
                last = close + 1;
            } else if (text_[next] == '.') {
                const std::size_t begin = skipSpace(next + 1);
                const std::size_t fieldEnd = wordEnd(begin);
                const std::string field = text_.substr(begin, fieldEnd - begin);
                if (field == "length") return;
                chain.push_back("." + field);
                last = fieldEnd;
            } else {
                break;
            }
        }
        const std::optional<Part> part = partOf(chain);
        if (!part) return;
        const int use = useOf(at, last);
        if ((use & kWrites) != 0) stores_ = true;
        if (index) {
            insert(index->first + 1,
                   fmt::format("countedElement({}, {}, {}u, {}u, {}u, ", number(part->block), use,
                               part->topLevelStride, part->offset, part->bytes));
            insert(index->second, ")");
        } else if ((use & kAtomic) != 0) {
            const std::size_t comma = skipSpace(last);
            insert(comma + 1,
                   fmt::format(" countedOperand({}, {}u,", number(part->block), part->offset));
            insert(argumentEnd(at, comma), ")");
        }
    }

    // By what stands around an expression.
    [[nodiscard]] int useOf(std::size_t at, std::size_t end) const {
        const std::size_t open = before(at);
        if (open != std::string::npos && text_[open] == '(') {
            const std::size_t nameEnd = open;
            std::size_t name = nameEnd;
            while (name > 0 && isWordCharacter(text_[name - 1]))
                --name;
            if (text_.compare(name, 6, "atomic") == 0) return kAtomic | kReads | kWrites;
        }
        const std::size_t next = skipSpace(end);
        const std::string two = text_.substr(next, 2);
        if (two == "++" || two == "--") return kReads | kWrites;
        if (two.size() == 2 && two[1] == '=' &&
            std::string("+-*/|&^%").find(two[0]) != std::string::npos)
            return kReads | kWrites;
        if (!two.empty() && two[0] == '=' && two != "==") return kWrites;
        return kReads;
    }

    std::string text_;
    const BlockLayout& layout_;
    std::vector<std::string>& names_;
    std::set<std::string> opaque_;
    std::set<std::string> members_;
    std::map<std::string, int> locals_;  // by name, the depth of braces that they live at
    int depth_ = 0;
    std::vector<std::pair<std::size_t, std::string>> insertions_;
    bool stores_ = false;
};

}  // namespace

std::string countingText(const std::string& text, CountingStage stage, const BlockLayout& layout,
                         std::vector<std::string>& names) {
    Counting counting(text, layout, names);
    const std::string counted = counting.run();
    const bool hasVertices =
        stage == CountingStage::vertex &&
        std::regex_search(counted,
                          std::regex(R"rx((^|\n)\s*layout\s*\(\s*location[^\n]*\)\s*in\s)rx"));
    std::string thread = "uint(gl_VertexID) + 61u * uint(gl_InstanceID)";
    if (stage == CountingStage::geometry) thread = "uint(gl_PrimitiveIDIn)";
    if (stage == CountingStage::compute)
        thread = "gl_LocalInvocationIndex + 61u * gl_WorkGroupID.x + 7u * gl_WorkGroupID.y";
    std::string head = prelude();
    std::string tail = "\nvoid main() {\n    countedMain();\n";
    if (stage == CountingStage::fragment) {
        head += kFragmentPrelude;
        thread = "countedThread()";
        static const std::regex output(R"rx((^|\n)\s*(layout\s*\([^)]*\)\s*)?out\s)rx");
        const auto outputs =
            std::distance(std::sregex_iterator(counted.begin(), counted.end(), output), {});
        head = fmt::format("const int kCountedOutputs = {};\n", outputs) + head;
        // A driver tests the depth first where it makes no difference; what counts would keep it
        // from that.
        const bool canTestFirst = !counting.stores() &&
                                  counted.find("discard") == std::string::npos &&
                                  counted.find("gl_FragDepth") == std::string::npos &&
                                  counted.find("early_fragment_tests") == std::string::npos;
        if (canTestFirst) head = "layout(early_fragment_tests) in;\n" + head;
        tail += "    countedTargets(countedTargetLayer < 0 ? gl_Layer : countedTargetLayer);\n";
    }
    if (hasVertices) {
        tail += fmt::format(
            "    countedElement({}, 1, countedShape[{}].y, 0u, countedShape[{}].y, "
            "gl_VertexID);\n",
            kCountedVertices, kCountedVertices, kCountedVertices);
    }
    tail += "    countedFlush(" + thread + ");\n}\n";

    const std::size_t version = counted.find('\n') + 1;
    static const std::regex main(R"rx(\bvoid\s+main\s*\(\s*(void)?\s*\))rx");
    return counted.substr(0, version) + head +
           std::regex_replace(counted.substr(version), main, "void countedMain()") + tail;
}

}  // namespace kaustik::gl
