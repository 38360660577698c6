// SPDX-License-Identifier: MIT
#include "tests/mixtures/refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "framework/core/error.h"

namespace kaustik::mixtures {
namespace {

// Whether the mixture goes with these, or is refused for something else that does not take them
// back.
bool helps(Bench& bench, Mixture mixture, const Settings& settings, const std::string& message) {
    for (const auto& [name, value] : settings)
        mixture.set(name, value);
    try {
        static_cast<void>(bench.render(mixture));
        return true;
    } catch (const ConfigError& error) {
        const std::string next = error.what();
        if (message.find(next) != std::string::npos) return false;
        const Settings instead = advised(next);
        return std::none_of(instead.begin(), instead.end(), [&](const auto& setting) {
            return settings.size() == 1 && setting.first == settings.front().first &&
                   setting.second != settings.front().second;
        });
    } catch (const DeviceError&) {
        return true;
    }
}

std::size_t sentencesIn(const std::string& text) {
    std::size_t sentences = text.ends_with('.') ? 1 : 0;
    for (std::size_t i = 0; i + 2 < text.size(); ++i)
        sentences += text[i] == '.' && text[i + 1] == ' ' ? 1 : 0;
    return sentences;
}

}  // namespace

Refusal refusalOf(const std::exception& error) {
    Refusal refusal{error.what()};
    const auto* device = dynamic_cast<const DeviceError*>(&error);
    refusal.isOfMemory =
        device != nullptr && (refusal.message.find("memory") != std::string::npos ||
                              refusal.message.find("MiB") != std::string::npos);
    refusal.isOfRequest = dynamic_cast<const ConfigError*>(&error) != nullptr;
    return refusal;
}

Settings advised(const std::string& text) {
    static const std::regex setting("([a-z_]+(?:\\.[a-z_0-9]+)*) ?= ?([A-Za-z0-9_.]*[A-Za-z0-9_])");
    const params::ParamSet params =
        registry().makeParams(registry().findTechnique(Mixture{}.technique));
    Settings settings;
    for (std::sregex_iterator at(text.begin(), text.end(), setting), end; at != end; ++at) {
        try {
            params::ParamSet tried = params;
            const std::string name = tried.resolve((*at)[1].str(), "");
            tried.set(name, (*at)[2].str(), "");
            settings.emplace_back(name, (*at)[2].str());
        } catch (const ConfigError&) {
            // Words that look like a setting.
        }
    }
    return settings;
}

std::string faultOf(Bench& bench, const Mixture& mixture, const Refusal& refusal) {
    const std::string& message = refusal.message;
    if (refusal.isOfMemory) return "";
    if (!refusal.isOfRequest) return message;
    if (!message.ends_with('.') || sentencesIn(message) > 2)
        return fmt::format("not one or two sentences: {}", message);
    const params::ParamSet params = paramsOf(mixture);
    // What stands after "take" is advice; what the mixture has anyway is what is refused.
    const auto take = message.find("take ");
    if (take == std::string::npos) return fmt::format("says not what to take: {}", message);
    Settings settings = advised(message.substr(take));
    std::erase_if(settings, [&](const auto& setting) {
        return params.find(setting.first).text() == setting.second;
    });
    if (settings.empty()) return fmt::format("names no setting to take: {}", message);
    for (const auto& setting : settings) {
        if (helps(bench, mixture, {setting}, message)) continue;
        const bool isOneAdvice = message.find(" or ", take) == std::string::npos;
        if (isOneAdvice && helps(bench, mixture, settings, message)) return "";
        return fmt::format("{}={} does not help: {}", setting.first, setting.second, message);
    }
    return "";
}

}  // namespace kaustik::mixtures
