// SPDX-License-Identifier: MIT
#include "framework/params/param_set.h"

#include <fmt/format.h>

#include <cxxabi.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik::params {
namespace {

std::string fullNameOf(const std::string& scope, const Field& field) {
    return field.name.empty() ? scope : scope + "." + field.name;
}

std::vector<std::string_view> splitAtDots(std::string_view name) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t dot = std::min(name.find('.', begin), name.size());
        parts.push_back(name.substr(begin, dot - begin));
        begin = dot + 1;
    }
    return parts;
}

// Whether `shortened`'s parts occur in `full`'s in order, the last one last.
bool abbreviates(std::string_view shortened, std::string_view full) {
    const auto wanted = splitAtDots(shortened);
    const auto parts = splitAtDots(full);
    if (wanted.back() != parts.back()) return false;
    std::size_t matched = 0;
    for (const std::string_view part : parts) {
        if (matched < wanted.size() && part == wanted[matched]) ++matched;
    }
    return matched == wanted.size();
}

std::string endOfMessage(std::string_view name, const std::vector<std::string>& candidates) {
    const std::string suggestion = didYouMean(name, candidates);
    return suggestion.empty() ? "." : suggestion;
}

// As written in the source.
std::string nameOf(const std::type_info& type) {
    const std::unique_ptr<char, void (*)(void*)> name(
        abi::__cxa_demangle(type.name(), nullptr, nullptr, nullptr), std::free);
    return name ? name.get() : type.name();
}

}  // namespace

ParamSet::ParamSet(const ParamSet& other)
    : defaults_(other.defaults_), formerNames_(other.formerNames_), setByUser_(other.setByUser_) {
    for (const auto& [scope, value] : other.scopes_)
        scopes_[scope] = value->clone();
}

ParamSet& ParamSet::operator=(const ParamSet& other) {
    if (this != &other) *this = ParamSet(other);
    return *this;
}

void ParamSet::add(const std::string& scope, std::unique_ptr<HeldBase> value) {
    // A stage's choice and its shared parameters live side by side under the same name.
    const std::string key = value->type() == typeid(NodeChoice) ? scope + "=" : scope;
    if (scopes_.contains(key)) {
        throw ConfigError(fmt::format("The parameters '{}' are declared twice.", scope));
    }
    for (const Field& field : value->fields()) {
        const std::string fullName = fullNameOf(scope, field);
        if (!defaults_.emplace(fullName, field.text()).second) {
            throw ConfigError(fmt::format("The parameter '{}' is declared twice.", fullName));
        }
        if (!field.formerName.empty()) formerNames_[scope + "." + field.formerName] = fullName;
    }
    scopes_[key] = std::move(value);
}

void ParamSet::declareChoice(const std::string& name, std::string sentence,
                             std::vector<std::string> options, const std::string& initial) {
    const auto found = std::find(options.begin(), options.end(), initial);
    assert(found != options.end() && "the initial choice is one of the options");
    const int index = static_cast<int>(found - options.begin());
    declare(name, NodeChoice{std::move(sentence), std::move(options), index});
}

ParamSet::HeldBase& ParamSet::held(const std::string& scope, const std::type_info& type) const {
    const auto found = scopes_.find(scope);
    if (found == scopes_.end()) {
        std::vector<std::string> names;
        for (const auto& [name, value] : scopes_) {
            if (value->type() != typeid(NodeChoice)) names.push_back(name);
        }
        throw ConfigError(fmt::format("No node or stage has declared the parameters '{}'{}", scope,
                                      endOfMessage(scope, names)));
    }
    if (found->second->type() != type) {
        throw ConfigError(fmt::format("The parameters '{}' are a {}, and are asked for as a {}.",
                                      scope, nameOf(found->second->type()), nameOf(type)));
    }
    return *found->second;
}

std::string ParamSet::choice(const std::string& name) const {
    return find(name).text();
}

Field ParamSet::find(const std::string& fullName) const {
    for (const auto& [key, value] : scopes_) {
        const std::string scope = key.back() == '=' ? key.substr(0, key.size() - 1) : key;
        if (fullName.compare(0, scope.size(), scope) != 0) continue;
        for (const Field& field : value->fields()) {
            if (fullNameOf(scope, field) == fullName) return field;
        }
    }
    std::vector<std::string> names;
    for (const auto& [name, text] : defaults_)
        names.push_back(name);
    throw ConfigError(
        fmt::format("There is no parameter '{}'{}", fullName, endOfMessage(fullName, names)));
}

std::vector<std::string> ParamSet::renamedFrom(std::string_view name) const {
    std::vector<std::string> result;
    for (const auto& [formerName, fullName] : formerNames_) {
        if (formerName == name) return {fullName};
        if (abbreviates(name, formerName)) result.push_back(fullName);
    }
    return result;
}

std::string ParamSet::resolve(std::string_view name, std::string_view where) const {
    std::vector<std::string> names;
    std::vector<std::string> matches;
    for (const auto& [fullName, text] : defaults_) {
        if (fullName == name) return fullName;
        names.push_back(fullName);
        if (abbreviates(name, fullName)) matches.push_back(fullName);
    }
    const std::vector<std::string> renamed = renamedFrom(name);
    if (matches.size() == 1 && renamed.empty()) return matches.front();
    if (matches.empty() && !renamed.empty()) {
        throw ConfigError(fmt::format("{}: there is no parameter '{}'; it is called '{}' now.",
                                      where, name, fmt::join(renamed, "' or '")));
    }
    matches.insert(matches.end(), renamed.begin(), renamed.end());
    if (matches.empty()) {
        throw ConfigError(
            fmt::format("{}: there is no parameter '{}'{} ('kaustik list params' "
                        "prints them all).",
                        where, name, didYouMean(name, names)));
    }
    throw ConfigError(
        fmt::format("{}: '{}' could be {}; write out which.", where, name, joinNames(matches)));
}

void ParamSet::set(std::string_view name, std::string_view value, std::string_view where) {
    const std::string fullName = resolve(name, where);
    find(fullName).set(value, fullName, where);
    setByUser_.insert(fullName);
}

void ParamSet::setDefault(std::string_view name, std::string_view value, std::string_view where) {
    const std::string fullName = resolve(name, where);
    const Field field = find(fullName);
    field.set(value, fullName, where);
    defaults_[fullName] = field.text();
}

bool ParamSet::isSetByUser(const std::string& fullName) const {
    return setByUser_.contains(fullName);
}

std::vector<NamedField> ParamSet::all() const {
    std::vector<NamedField> result;
    for (const auto& [key, value] : scopes_) {
        const std::string scope = key.back() == '=' ? key.substr(0, key.size() - 1) : key;
        for (Field& field : value->fields()) {
            const std::string fullName = fullNameOf(scope, field);
            result.push_back({fullName, std::move(field), defaults_.at(fullName)});
        }
    }
    // A stage's choice before what its nodes share, and these before what each has of its own.
    const auto scopeOf = [](const NamedField& named) {
        const std::size_t nameBytes = named.field.name.empty() ? 0 : named.field.name.size() + 1;
        return std::pair(named.fullName.substr(0, named.fullName.size() - nameBytes),
                         nameBytes != 0);
    };
    std::stable_sort(result.begin(), result.end(), [&](const NamedField& a, const NamedField& b) {
        return scopeOf(a) < scopeOf(b);
    });
    return result;
}

nlohmann::json ParamSet::json() const {
    nlohmann::json result = nlohmann::json::object();
    for (const NamedField& named : all())
        result[named.fullName] = named.field.json();
    return result;
}

}  // namespace kaustik::params
