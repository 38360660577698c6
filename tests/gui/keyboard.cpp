// SPDX-License-Identifier: MIT
#include "tests/gui/keyboard.h"

#include <X11/XKBlib.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

namespace kaustik::test {
namespace {

struct Key {
    unsigned code = 0;
    bool isShifted = false;
};

std::optional<Key> keyOfSymbol(Display* display, KeySym symbol) {
    int first = 0;
    int last = 0;
    XDisplayKeycodes(display, &first, &last);
    for (const unsigned level : {0u, 1u}) {
        for (int code = first; code <= last; ++code) {
            const KeySym found =
                XkbKeycodeToKeysym(display, static_cast<KeyCode>(code), 0, static_cast<int>(level));
            if (found == symbol) return Key{static_cast<unsigned>(code), level == 1};
        }
    }
    return std::nullopt;
}

KeySym symbolNamed(const std::string& name) {
    static const std::map<std::string, KeySym> others = {
        {"ctrl", XK_Control_L}, {"shift", XK_Shift_L}, {"alt", XK_Alt_L},
        {"super", XK_Super_L},  {"\n", XK_Return},     {"\t", XK_Tab}};
    if (const auto other = others.find(name); other != others.end()) return other->second;
    // X numbers printable ASCII as ASCII does.
    if (name.size() == 1 && name[0] >= ' ' && name[0] <= '~') return static_cast<KeySym>(name[0]);
    return XStringToKeysym(name.c_str());
}

std::vector<std::string> namesIn(const std::string& chord) {
    std::vector<std::string> names;
    std::size_t begin = 0;
    // A plus sign at a name's place is that name.
    for (std::size_t plus; (plus = chord.find('+', begin)) != std::string::npos && plus != begin;
         begin = plus + 1) {
        names.push_back(chord.substr(begin, plus - begin));
    }
    names.push_back(chord.substr(begin));
    return names;
}

}  // namespace

std::vector<unsigned> keyCodesOf(_XDisplay* display, const std::string& chord) {
    std::vector<unsigned> codes;
    const auto add = [&](unsigned code) {
        if (std::find(codes.begin(), codes.end(), code) == codes.end()) codes.push_back(code);
    };
    for (const std::string& name : namesIn(chord)) {
        const KeySym symbol = symbolNamed(name);
        const std::optional<Key> key =
            symbol == NoSymbol ? std::nullopt : keyOfSymbol(display, symbol);
        if (!key) throw std::runtime_error("There is no key '" + name + "' for '" + chord + "'.");
        if (key->isShifted) add(keyOfSymbol(display, XK_Shift_L).value().code);
        add(key->code);
    }
    return codes;
}

}  // namespace kaustik::test
