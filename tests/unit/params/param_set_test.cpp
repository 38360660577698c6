// SPDX-License-Identifier: MIT
#include "framework/params/assignment.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/core/error.h"

namespace kaustik {
// What this program knows of a frame.
struct FrameFacts {
    bool hasPhotons = true;
};
}  // namespace kaustik

namespace kaustik::params {
namespace {

enum class Kernel : int { linear, gaussian };

struct TraceParams {
    float epsilonMeters = 0.01f;
    template <class R>
    void reflect(R& r) {
        r.field(epsilonMeters, "epsilon", "Largest distance that counts as a hit", "m",
                range(1e-6f, 1.0f));
    }
};

struct LinesParams {
    int width = 1024;
    bool blur = false;
    template <class R>
    void reflect(R& r) {
        r.field(width, "width", "Texels in a row", "texels", range(1, 4096));
        r.field(blur, "blur", "Whether to blur");
    }
};

struct SpritesParams {
    int width = 3;
    Kernel kernel = Kernel::linear;
    Extent grid{256, 256};
    template <class R>
    void reflect(R& r) {
        r.field(width, "width", "Width of a sprite", "px", range(1, 99));
        r.choice(kernel, "kernel", "Shape of the splat", {"linear", "gaussian"});
        r.field(grid, "grid", "Size of the grid", "", range(1, 2048));
    }
};

// Whose parameter was called `maximum` before.
struct StepsParams {
    int maxSteps = 64;
    template <class R>
    void reflect(R& r) {
        r.field(maxSteps, "max_steps", "Steps of a ray", "", range(1, 4096));
        r.renamed("most", "max_steps");
    }
};

struct CountParams {
    int maximum = 3;
    template <class R>
    void reflect(R& r) {
        r.field(maximum, "most", "Cells in a row", "", range(1, 9));
    }
};

struct LargeParams {
    int count = 1;
    float power = 1.0f;
    template <class R>
    void reflect(R& r) {
        r.field(count, "count", "Photons", "", range(1, 1 << 28));
        r.field(power, "power", "Power", "W", range(1e-6f, 1e6f));
    }
};

ParamSet makeSet() {
    ParamSet set;
    set.declareChoice("trace", "Which tracer", {"lines", "march"}, "lines");
    set.declare<TraceParams>("trace");
    set.declare<LinesParams>("trace.lines");
    set.declare<SpritesParams>("reconstruct.sprites");
    return set;
}

std::string messageOf(ParamSet& set, const std::string& assignment) {
    try {
        assign(set, {parseAssignment(assignment, "--set")});
    } catch (const ConfigError& error) {
        EXPECT_EQ(error.exitCode(), kExitBadRequest);
        return error.what();
    }
    return "";
}

TEST(ParamSet, TakesFullNamesAndShorterOnesThatAreUnique) {
    ParamSet set = makeSet();
    assign(set, {parseAssignment("trace.epsilon=0.5", "--set")});
    EXPECT_EQ(set.get<TraceParams>("trace").epsilonMeters, 0.5f);
    assign(set, {parseAssignment("epsilon=0.25", "--set")});
    EXPECT_EQ(set.get<TraceParams>("trace").epsilonMeters, 0.25f);
    assign(set, {parseAssignment("lines.width=7", "--set")});
    EXPECT_EQ(set.get<LinesParams>("trace.lines").width, 7);
    assign(set, {parseAssignment("trace.width=9", "--set")});
    EXPECT_EQ(set.get<LinesParams>("trace.lines").width, 9);
    assign(set, {parseAssignment("grid=64x32", "--set")});
    EXPECT_EQ(set.get<SpritesParams>("reconstruct.sprites").grid, (Extent{64, 32}));
}

TEST(ParamSet, RefusesAnAmbiguousNameAndSaysWhatItCouldBe) {
    ParamSet set = makeSet();
    const std::string message = messageOf(set, "width=7");
    EXPECT_NE(message.find("reconstruct.sprites.width and trace.lines.width"), std::string::npos);
    EXPECT_EQ(set.get<LinesParams>("trace.lines").width, 1024);
}

TEST(Field, TakesTheValuesOfItsListAlone) {
    int samples = 1;
    FieldList list;
    const Field field = list.field(samples, "samples", "Samples", "", range(1, 9)).only({1, 4, 9});
    EXPECT_EQ(field.rangeText(), "1 | 4 | 9");
    field.set("4", "eye.samples", "--set");
    EXPECT_EQ(samples, 4);
    for (const std::string text : {"5", "100"}) {
        try {
            field.set(text, "eye.samples", "--set");
            FAIL();
        } catch (const ConfigError& error) {
            EXPECT_EQ(error.what(),
                      "--set: eye.samples cannot be '" + text + "'; it takes 1, 4, 9.");
        }
    }
    EXPECT_EQ(samples, 4);
}

TEST(ParamSet, NamesTheNearestParameterWhenOneIsUnknown) {
    ParamSet set = makeSet();
    EXPECT_NE(messageOf(set, "trace.epsilom=1").find("did you mean 'trace.epsilon'"),
              std::string::npos);
    EXPECT_NE(messageOf(set, "epsilon").find("name=value"), std::string::npos);
}

TEST(ParamSet, NamesTheParameterThatWasCalledOtherwiseBefore) {
    ParamSet set;
    set.declare<StepsParams>("trace.march");
    const ParamSet copy = set;
    for (ParamSet each : {set, copy}) {
        for (const char* former : {"trace.march.most=7", "march.most=7", "most=7"}) {
            const std::string message = messageOf(each, former);
            EXPECT_NE(message.find("it is called 'trace.march.max_steps' now"), std::string::npos)
                << message;
        }
        EXPECT_EQ(each.get<StepsParams>("trace.march").maxSteps, 64);
        each.set("max_steps", "7", "--set");
        EXPECT_EQ(each.get<StepsParams>("trace.march").maxSteps, 7);
    }
}

TEST(ParamSet, AShortNameOfOneParameterThatAnotherHadBeforeIsAmbiguous) {
    ParamSet set;
    set.declare<StepsParams>("trace.march");
    set.declare<CountParams>("emit.grid");
    EXPECT_NE(messageOf(set, "most=7").find("emit.grid.most and trace.march.max_steps"),
              std::string::npos);
    set.set("grid.most", "7", "--set");
    EXPECT_EQ(set.get<CountParams>("emit.grid").maximum, 7);
}

TEST(ParamSet, EnforcesRangesAndTypesAndLeavesTheValueAlone) {
    ParamSet set = makeSet();
    for (const char* bad :
         {"epsilon=0", "epsilon=1.5", "epsilon=nan", "epsilon=inf", "epsilon=1e99", "epsilon=0.1m",
          "epsilon=", "lines.width=0", "lines.width=4097", "lines.width=3.5",
          "lines.width=99999999999", "blur=maybe", "kernel=cubic", "grid=0x4", "grid=64",
          "grid=64x", "grid=9999x64"}) {
        EXPECT_NE(messageOf(set, bad), "") << bad;
    }
    EXPECT_EQ(set.json(), makeSet().json());
    EXPECT_TRUE(set.setByUser().empty());
}

TEST(ParamSet, AcceptsBothEndsOfARange) {
    ParamSet set = makeSet();
    EXPECT_EQ(messageOf(set, "epsilon=1e-6"), "");
    EXPECT_EQ(messageOf(set, "epsilon=1"), "");
    EXPECT_EQ(messageOf(set, "lines.width=4096"), "");
}

TEST(ParamSet, AStageIsSetLikeAParameter) {
    ParamSet set = makeSet();
    EXPECT_EQ(set.choice("trace"), "lines");
    assign(set, {parseAssignment("trace=march", "--set")});
    EXPECT_EQ(set.choice("trace"), "march");
    const std::string message = messageOf(set, "trace=marsh");
    EXPECT_NE(message.find("did you mean 'march'"), std::string::npos);
}

TEST(ParamSet, WritesFullNamesAndNumbersThatReadBackAsTheSameFloat) {
    ParamSet set = makeSet();
    const nlohmann::json json = set.json();
    EXPECT_EQ(json.at("trace"), "lines");
    EXPECT_EQ(json.at("trace.epsilon").dump(), "0.01");
    EXPECT_EQ(json.at("reconstruct.sprites.grid"), "256x256");
    EXPECT_EQ(json.at("reconstruct.sprites.kernel"), "linear");
    EXPECT_EQ(json.size(), 7u);
}

TEST(ParamSet, ListsScopesByNameAndTheirParametersInTheOrderOfDeclaration) {
    std::vector<std::string> names;
    for (const NamedField& named : makeSet().all())
        names.push_back(named.fullName);
    EXPECT_EQ(names,
              (std::vector<std::string>{"reconstruct.sprites.width", "reconstruct.sprites.kernel",
                                        "reconstruct.sprites.grid", "trace", "trace.epsilon",
                                        "trace.lines.width", "trace.lines.blur"}));
}

TEST(ParamSet, SaysLimitsThatAreWholeNumbersWithAllTheirDigits) {
    ParamSet set;
    set.declare<LargeParams>("emit");
    EXPECT_EQ(set.find("emit.count").rangeText(), "1 to 268435456");
    EXPECT_EQ(set.find("emit.power").rangeText(), "1e-06 to 1000000");
    EXPECT_NE(messageOf(set, "count=0").find("a whole number from 1 to 268435456."),
              std::string::npos);
    EXPECT_NE(messageOf(set, "power=0").find("a number from 1e-06 to 1000000 W."),
              std::string::npos);
}

TEST(ParamSet, ATechniquesDefaultIsNotCountedAsTheUsers) {
    ParamSet set = makeSet();
    set.setDefault("trace", "march", "a test");
    EXPECT_EQ(set.choice("trace"), "march");
    EXPECT_FALSE(set.isSetByUser("trace"));
    assign(set, {parseAssignment("trace=lines", "--set")});
    EXPECT_TRUE(set.isSetByUser("trace"));
}

// What a technique's author can get wrong about parameters is an error with names, in every build.
template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ParamSet, AMistypedScopeIsAnsweredWithTheNearest) {
    const ParamSet set = makeSet();
    EXPECT_EQ(errorOf([&] { static_cast<void>(set.get<LinesParams>("trace.lins")); }),
              "No node or stage has declared the parameters 'trace.lins'; did you mean "
              "'trace.lines'?");
    EXPECT_NE(errorOf([&] { static_cast<void>(set.get<LinesParams>("")); }).find("''"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { static_cast<void>(set.choice("trase")); }).find("mean 'trace'?"),
              std::string::npos);
}

TEST(ParamSet, AScopeAskedForAsAnotherStructNamesBoth) {
    const ParamSet set = makeSet();
    const std::string message =
        errorOf([&] { static_cast<void>(set.get<TraceParams>("trace.lines")); });
    for (const char* part : {"'trace.lines'", "LinesParams", "TraceParams"})
        EXPECT_NE(message.find(part), std::string::npos) << message;
}

struct TwiceParams {
    int one = 1;
    int two = 2;
    template <class R>
    void reflect(R& r) {
        r.field(one, "size", "A size", "", range(1, 9));
        r.field(two, "size", "The same name", "", range(1, 9));
    }
};

TEST(ParamSet, AParameterThatIsDeclaredTwiceIsNamed) {
    ParamSet set = makeSet();
    EXPECT_EQ(errorOf([&] { set.declare<LinesParams>("trace.lines"); }),
              "The parameters 'trace.lines' are declared twice.");
    EXPECT_EQ(errorOf([&] { set.declare<TwiceParams>("emit.twice"); }),
              "The parameter 'emit.twice.size' is declared twice.");
}

struct NamelessParams {
    Kernel kernel = Kernel::gaussian;
    template <class R>
    void reflect(R& r) {
        r.choice(kernel, "kernel", "Shape of the splat", {"linear"});
    }
};

TEST(ParamSet, AChoiceWhoseDefaultHasNoNameIsNamed) {
    ParamSet set;
    EXPECT_NE(errorOf([&] { set.declare<NamelessParams>("splat"); }).find("'kernel'"),
              std::string::npos);
}

TEST(ParamSet, ATechniquesMistypedDefaultNamesTheTechnique) {
    ParamSet set = makeSet();
    const std::string message =
        errorOf([&] { set.setDefault("trace", "marhc", "technique 'mine'"); });
    EXPECT_NE(message.find("technique 'mine': trace cannot be 'marhc'; did you mean 'march'?"),
              std::string::npos)
        << message;
}

TEST(ParamSet, ACopyHasValuesOfItsOwn) {
    ParamSet set = makeSet();
    ParamSet copy = set;
    assign(copy, {parseAssignment("lines.width=5", "--set")});
    EXPECT_EQ(set.get<LinesParams>("trace.lines").width, 1024);
    EXPECT_EQ(copy.get<LinesParams>("trace.lines").width, 5);
}

struct WidthParams {
    int width = 0;
    int footprints = 2;
    template <class R>
    void reflect(R& r) {
        r.field(width, "width", "Width; 0: by the footprint", "px", range(0, 9));
        r.field(footprints, "footprints", "Widths of the footprint", "", range(1, 9))
            .when(width == 0, "its width is set")
            .when([](const FrameFacts& facts) { return facts.hasPhotons ? "" : "it is dark"; });
    }
};

TEST(Condition, IsAskedOfTheValuesAsTheyAreAndOfWhatIsKnown) {
    ParamSet set;
    set.declare<WidthParams>("media");
    EXPECT_TRUE(set.find("media.width").conditions.empty());
    const Field footprints = set.find("media.footprints");
    EXPECT_EQ(footprints.obstacle, "");
    ASSERT_EQ(footprints.conditions.size(), 1u);
    EXPECT_EQ(footprints.conditions.front()({.hasPhotons = true}), "");
    EXPECT_EQ(footprints.conditions.front()({.hasPhotons = false}), "it is dark");
    set.set("media.width", "3", "test");
    EXPECT_EQ(set.find("media.footprints").obstacle, "its width is set");
}

}  // namespace
}  // namespace kaustik::params
