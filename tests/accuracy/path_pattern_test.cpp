// SPDX-License-Identifier: MIT
// Patterns of paths: what they take, next to another machine for regular expressions; and what is
// said of those that are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/reference/path_classes.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

PathWord wordOf(const std::string& text) {
    PathWord word;
    for (const char c : text) {
        if (c == 'R') word.reflections |= std::uint64_t{1} << word.length;
        ++word.length;
    }
    return word;
}

// All words of up to so many interactions.
std::vector<std::string> wordsUpTo(int length) {
    std::vector<std::string> words{""};
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (static_cast<int>(words[i].size()) == length) continue;
        words.push_back(words[i] + 'T');
        words.push_back(words[i] + 'R');
    }
    return words;
}

TEST(PathPattern, TakesTheWordsThatTheStandardsExpressionsTake) {
    const std::vector<std::string> patterns = {
        "TT",         "TR*T",      "TR+T",        "S",           "SS?",       "(TT)+",
        "T|R",        "(T|RR)*TT", "T{2}R{1,3}",  "(TR?){2,}",   "R+|T(R|T)", "S{3,5}",
        "(S(T|R)S)?", "((T))",     "(T*)*R(R?)+", "(TR|RT){1,2}"};
    for (const std::string& pattern : patterns) {
        const PathPattern ours(pattern, "test");
        const std::regex theirs(std::regex_replace(pattern, std::regex("S"), "[TR]"));
        int taken = 0;
        for (const std::string& word : wordsUpTo(7)) {
            const bool isTaken = ours.matches(wordOf(word));
            EXPECT_EQ(isTaken, std::regex_match(word, theirs)) << pattern << " of " << word;
            taken += isTaken ? 1 : 0;
        }
        EXPECT_GT(taken, 0) << pattern;
    }
}

TEST(PathPattern, IsAsHeckbertWritesIt) {
    const PathPattern pattern(" L T R+ T D @ my ball ", "test");
    EXPECT_EQ(pattern.text(), "TR+T");
    EXPECT_EQ(pattern.object(), "my ball");
    EXPECT_TRUE(pattern.matches(wordOf("TRRT")));
    EXPECT_FALSE(pattern.matches(wordOf("TT")));
    EXPECT_EQ(textOf(wordOf("TRRT")), "TRRT");
}

// A machine that tries one way after the other would take 2^64 steps.
TEST(PathPattern, OfManyWaysToTheSameWordTakesNoLonger) {
    const PathPattern pattern("((T|S)*(T|S)*)*R", "test");
    EXPECT_FALSE(pattern.matches(wordOf(std::string(kLongestPathWord, 'T'))));
}

TEST(PathPattern, ThatIsNoneIsRefusedByWhatIsWrongWithIt) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"L T X D", "'X' is no interaction"},
        {"", "no interaction"},
        {"LD", "no interaction"},
        {"T(R", "not closed"},
        {"T)", "no '('"},
        {"T()", "without an interaction"},
        {"T||R", "without an interaction"},
        {"*T", "nothing before it"},
        {"T+*", "two repeats"},
        {"T{3,1}", "at least 3 and at most 1"},
        {"T{0}", "1 to 64"},
        {"T{65}", "1 to 64"},
        {"T{99999999999999999999}", "1 to 64"},
        {"T{x}", "needs {n}"},
        {"T{2", "needs {n}"},
        {"(((T{64}){64}){64}){64}", "repeats too much"},
        {std::string(200, '(') + "T" + std::string(200, ')'), "too deep"},
        {"TT@ ", "no object"}};
    for (const auto& [text, reason] : cases) {
        const std::string message = test::messageOf<ConfigError>(
            [&, wrong = text] { static_cast<void>(PathPattern(wrong, "--class")); });
        EXPECT_TRUE(message.starts_with("--class: ")) << message;
        EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
}

TEST(PathClasses, HaveTheNameThatIsGivenOrTheirPatterns) {
    EXPECT_EQ(pathClassOf("L T T D", "test"), (PathClass{"TT", "TT"}));
    EXPECT_EQ(pathClassOf("inside=TR+T", "test"), (PathClass{"inside", "TR+T"}));
    EXPECT_EQ(pathClassOf("S@left ball.2", "test"), (PathClass{"S@left_ball_2", "S@left ball.2"}));
    EXPECT_EQ(pathClassOf("S@a=b", "test"), (PathClass{"S@a=b", "S@a=b"}));
    for (const char* name : {"a b=T", "=T", "a.b=T"})
        EXPECT_THROW(static_cast<void>(pathClassOf(name, "test")), ConfigError) << name;
}

TEST(PathClasses, OfAPathAreTheFirstThatTakesIt) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    std::uint32_t ball = 0;
    while (scene::isReceiver(scene.materials[scene.objects[ball].material].kind))
        ++ball;
    const std::vector<PathClass> classes = {
        {"a", "TT"}, {"b", "T+@" + scene.objects[ball].name}, {"c", "S+"}};
    PathClassifier classifier(scene, classes);
    const auto classOf = [&](const std::string& word, std::uint32_t object) {
        return classifier.classOf({wordOf(word), static_cast<int>(word.size()), object, false});
    };
    for (int time = 0; time < 2; ++time) {  // as found, and as remembered
        EXPECT_EQ(classOf("TT", ball), 0u);
        EXPECT_EQ(classOf("TTT", ball), 1u);
        EXPECT_EQ(classOf("TTT", ball == 0 ? 1 : 0), 2u);
        EXPECT_EQ(classOf("R", ball), 2u);
        // Longer than words are kept.
        EXPECT_EQ(classifier.classOf({{0, kLongestPathWord}, kLongestPathWord + 1, ball, false}),
                  3u);
    }
}

TEST(PathClasses, ThatCannotBeKeptAreRefused) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const auto refusal = [&](const std::vector<PathClass>& classes) {
        return test::messageOf<ConfigError>([&] { requireClasses(classes, scene, "--class"); });
    };
    EXPECT_NE(refusal({{"other", "T"}}).find("'other'"), std::string::npos);
    EXPECT_NE(refusal({{"a", "T"}, {"a", "R"}}).find("two classes are called 'a'"),
              std::string::npos);
    EXPECT_NE(refusal({{"a", "T@bal"}}).find("no specular object 'bal'"), std::string::npos);
    EXPECT_NE(refusal(std::vector<PathClass>(65, {"a", "T"})).find("more than the 64"),
              std::string::npos);
}

}  // namespace
}  // namespace kaustik::reference
