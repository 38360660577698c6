// SPDX-License-Identifier: MIT
// That one declaration of a table's keys reads it and describes it.
#include "framework/scene/files/table_schema.h"

#include <gtest/gtest.h>

#include "framework/core/error.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::scene {

enum class Drink { tea, milk };

struct Sugar {
    unsigned lumps = 2;
};
template <class R>
void reflect(R& r, Sugar& sugar) {
    r.count(sugar.lumps, {"lumps", "How many"}, 0, 4, kHasDefault);
}

struct Cup {
    Drink drink = Drink::tea;
    double liters = 0.0;
    glm::dvec3 color{1.0};
    std::optional<double> fat;
    std::vector<Sugar> sugar;
};
template <class R>
void reflect(R& r, Cup& cup) {
    r.kind(cup.drink, {"drink", "What is in it"}, {{"tea", Drink::tea}, {"milk", Drink::milk}});
    r.number(cup.liters, {"liters", "How much", "l"}, {0.0, 1.5, true, false});
    r.uniformOrVector(cup.color, {"color", "Of the cup"}, kUnitInterval, kHasDefault);
    if (cup.drink == Drink::milk) r.number(cup.fat, {"fat", "Share of it"}, kUnitInterval);
    r.tables(cup.sugar, {"sugar", "In each cube"});
}

namespace {

using nlohmann::json;

TomlNode tableOf(std::vector<TomlEntry> entries) {
    TomlNode table;
    table.value = TomlTable{std::move(entries), true};
    return table;
}
template <class T>
TomlEntry entry(const char* key, T value) {
    TomlEntry entry;
    entry.key = key;
    entry.node.value = std::move(value);
    return entry;
}

Cup read(const TomlNode& table) {
    return TableReader(table, "menu.toml", "cup").read<Cup>();
}

std::string problem(const TomlNode& table) {
    return test::messageOf<ConfigError>([&] { static_cast<void>(read(table)); });
}

TEST(TableSchema, DescribesEachKindOfATableWithItsKeys) {
    const json schema = tableSchema<Cup>();
    ASSERT_EQ(schema.at("oneOf").size(), 2u);
    const json& tea = schema["oneOf"][0];
    const json& milk = schema["oneOf"][1];
    EXPECT_EQ(tea.at("required"), json({"drink", "liters"}));
    EXPECT_EQ(tea.at("additionalProperties"), false);
    EXPECT_EQ(tea.at("properties").at("drink"), json({{"const", "tea"}}));
    EXPECT_EQ(tea.at("properties").at("liters"), json({{"type", "number"},
                                                       {"exclusiveMinimum", 0},
                                                       {"maximum", 1.5},
                                                       {"description", "How much, l"}}));
    EXPECT_EQ(tea.at("properties").at("color").at("default"), 1);
    EXPECT_FALSE(tea.at("properties").contains("fat"));
    EXPECT_EQ(milk.at("properties").at("drink"), json({{"const", "milk"}}));
    EXPECT_FALSE(milk.at("properties").at("fat").contains("default"));
    EXPECT_EQ(milk.at("properties").at("sugar").at("items").at("properties").at("lumps"),
              json({{"type", "integer"},
                    {"minimum", 0},
                    {"maximum", 4},
                    {"default", 2},
                    {"description", "How many"}}));
}

TEST(TableSchema, IsWhatTheReaderReads) {
    const TomlNode table = tableOf(
        {entry<std::string>("drink", "milk"), entry<double>("liters", 0.5),
         entry<double>("fat", 0.25),
         entry("sugar", TomlList{{tableOf({entry<std::int64_t>("lumps", 3)}), tableOf({})}})});
    const Cup cup = read(table);
    EXPECT_EQ(cup.drink, Drink::milk);
    EXPECT_EQ(cup.liters, 0.5);
    EXPECT_EQ(cup.color, glm::dvec3(1.0));
    EXPECT_EQ(cup.fat, 0.25);
    ASSERT_EQ(cup.sugar.size(), 2u);
    EXPECT_EQ(cup.sugar[0].lumps, 3u);
    EXPECT_EQ(cup.sugar[1].lumps, 2u);
}

TEST(TableSchema, OfOneKindHasNoKeysOfAnother) {
    EXPECT_EQ(problem(tableOf({entry<std::string>("drink", "tea"), entry<double>("liters", 0.5),
                               entry<double>("fat", 0.25)})),
              "menu.toml:1: cup: 'fat' is not a key; the keys are drink, liters, color and sugar.");
    EXPECT_EQ(problem(tableOf({entry<std::string>("drink", "tea")})),
              "menu.toml:1: cup: 'liters' is missing.");
    EXPECT_EQ(problem(tableOf({entry<std::string>("drink", "tea"), entry<double>("liters", 0.0)})),
              "menu.toml:1: cup: liters must be greater than 0 and at most 1.5, not 0.");
    EXPECT_EQ(problem(tableOf({})), "menu.toml:1: cup: 'drink' is missing.");
}

}  // namespace
}  // namespace kaustik::scene
