// SPDX-License-Identifier: MIT
// A reader of pbrt-v4 scene files for tests, written from "pbrt-v4 Input File Format" alone
// (https://pbrt.org/fileformat-v4): directives, quoted strings, parameter lists in brackets,
// comments, the current transformation, and attributes. It knows nothing of what wrote the file.
#pragma once

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace kaustik::test {

struct PbrtParameter {
    std::string type;  // "float"
    std::vector<double> numbers;
    std::vector<std::string> texts;
};
using PbrtParameters = std::map<std::string, PbrtParameter>;

struct PbrtStatement {
    std::string directive;
    std::vector<std::string> names;  // plain quoted strings before the parameters
    PbrtParameters parameters;
    glm::dmat4 toCurrent{1.0};  // the current transformation matrix
    std::string material;       // of a shape: the one in force
    std::string interior;
    PbrtParameters areaLight;
};

struct PbrtFile {
    std::vector<PbrtStatement> options;  // before WorldBegin
    std::vector<PbrtStatement> world;
    glm::dmat4 worldToCamera{1.0};
};

namespace pbrt_parser {

struct Token {
    std::string text;
    bool isQuoted = false;
};

inline std::vector<Token> tokensOf(const std::string& text) {
    std::vector<Token> tokens;
    std::size_t i = 0;
    while (i < text.size()) {
        const char c = text[i];
        if (c == '#') {
            i = std::min(text.find('\n', i), text.size());
        } else if (c == '"') {
            const std::size_t end = text.find('"', i + 1);
            if (end == std::string::npos) throw std::runtime_error("a string without an end");
            tokens.push_back({text.substr(i + 1, end - i - 1), true});
            i = end + 1;
        } else if (c == '[' || c == ']') {
            tokens.push_back({std::string(1, c), false});
            ++i;
        } else if (std::string(" \t\r\n").find(c) != std::string::npos) {
            ++i;
        } else {
            const std::size_t end = std::min(text.find_first_of(" \t\r\n[]\"#", i), text.size());
            tokens.push_back({text.substr(i, end - i), false});
            i = end;
        }
    }
    return tokens;
}

inline bool isNumber(const Token& token) {
    return !token.isQuoted && token.text.find_first_not_of("+-.eE0123456789") == std::string::npos;
}

// As the page describes LookAt: left-handed, +z towards the target.
inline glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& at, const glm::dvec3& up) {
    const glm::dvec3 direction = glm::normalize(at - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::normalize(up), direction));
    const glm::dvec3 newUp = glm::cross(direction, right);
    const glm::dmat4 toWorld(glm::dvec4(right, 0), glm::dvec4(newUp, 0), glm::dvec4(direction, 0),
                             glm::dvec4(eye, 1));
    return glm::inverse(toWorld);
}

}  // namespace pbrt_parser

inline PbrtFile parsePbrt(const std::string& text) {
    using namespace pbrt_parser;
    const std::vector<Token> tokens = tokensOf(text);
    PbrtFile file;
    struct State {
        glm::dmat4 current{1.0};
        std::string material;
        std::string interior;
        PbrtParameters areaLight;
    };
    State state;
    std::vector<State> stack;
    bool isWorld = false;
    std::size_t i = 0;
    while (i < tokens.size()) {
        if (tokens[i].isQuoted || isNumber(tokens[i]))
            throw std::runtime_error("'" + tokens[i].text + "' where a directive is expected");
        PbrtStatement statement;
        statement.directive = tokens[i++].text;
        std::vector<double> bare;
        while (i < tokens.size() && isNumber(tokens[i]))
            bare.push_back(std::stod(tokens[i++].text));
        while (i < tokens.size() && tokens[i].isQuoted) {
            const bool isParameter = i + 1 < tokens.size() && tokens[i + 1].text == "[" &&
                                     tokens[i].text.find(' ') != std::string::npos;
            if (!isParameter) {
                statement.names.push_back(tokens[i++].text);
                continue;
            }
            const std::size_t blank = tokens[i].text.find(' ');
            PbrtParameter parameter;
            parameter.type = tokens[i].text.substr(0, blank);
            const std::string name = tokens[i].text.substr(blank + 1);
            for (i += 2; i < tokens.size() && tokens[i].text != "]"; ++i) {
                if (tokens[i].isQuoted) {
                    parameter.texts.push_back(tokens[i].text);
                } else {
                    parameter.numbers.push_back(std::stod(tokens[i].text));
                }
            }
            ++i;
            statement.parameters[name] = parameter;
        }
        if (statement.directive == "Scale") {
            state.current = glm::scale(state.current, glm::dvec3(bare[0], bare[1], bare[2]));
        } else if (statement.directive == "LookAt") {
            state.current =
                state.current * lookAt({bare[0], bare[1], bare[2]}, {bare[3], bare[4], bare[5]},
                                       {bare[6], bare[7], bare[8]});
        } else if (statement.directive == "WorldBegin") {
            state.current = glm::dmat4(1.0);
            isWorld = true;
            continue;
        } else if (statement.directive == "AttributeBegin") {
            stack.push_back(state);
            continue;
        } else if (statement.directive == "AttributeEnd") {
            state = stack.back();
            stack.pop_back();
            continue;
        } else if (statement.directive == "NamedMaterial") {
            state.material = statement.names.front();
        } else if (statement.directive == "MediumInterface") {
            state.interior = statement.names.front();
        } else if (statement.directive == "AreaLightSource") {
            state.areaLight = statement.parameters;
        } else if (statement.directive == "Camera") {
            file.worldToCamera = state.current;
        }
        statement.toCurrent = state.current;
        statement.material = state.material;
        statement.interior = state.interior;
        statement.areaLight = state.areaLight;
        (isWorld ? file.world : file.options).push_back(statement);
    }
    return file;
}

}  // namespace kaustik::test
