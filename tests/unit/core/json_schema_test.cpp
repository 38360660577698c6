// SPDX-License-Identifier: MIT
#include "framework/core/json_schema.h"

#include <gtest/gtest.h>

namespace kaustik::test {

struct Wheel {
    double meters = 0.0;
};
template <class F>
void reflect(F& f, const Wheel& wheel) {
    f.field("diameter_m", wheel.meters, "Across");
}

struct Cart {
    std::vector<Wheel> wheels;
    std::optional<Wheel> spare;
    std::optional<double> speed;
    bool moves = false;
};
template <class F>
void reflect(F& f, const Cart& cart) {
    f.field("wheels", cart.wheels, "All of them");
    f.field("spare", cart.spare, "");
    f.fieldOrNull("speed_m_s", cart.speed, "it stands", "How fast it is");
    f.choice("state", cart.moves ? "moves" : "stands", {"moves", "stands"}, "");
}

namespace {

using nlohmann::json;

TEST(JsonSchema, WritesWhatThereIsAndSaysWhyANumberIsNone) {
    EXPECT_EQ(jsonOf(Cart{{{0.5}, {1.5}}, {}, {}, false}),
              json::parse(R"({"wheels": [{"diameter_m": 0.5}, {"diameter_m": 1.5}],
                              "speed_m_s": null, "state": "stands",
                              "reasons": {"speed_m_s": "it stands"}})"));
    EXPECT_EQ(jsonOf(Cart{{}, Wheel{1.0}, 3.0, true}),
              json::parse(R"({"wheels": [], "spare": {"diameter_m": 1.0}, "speed_m_s": 3.0,
                              "state": "moves"})"));
}

TEST(JsonSchema, DescribesAllThatMayBeWritten) {
    const json wheel = json::parse(R"({"type": "object", "required": ["diameter_m"],
        "additionalProperties": false,
        "properties": {"diameter_m": {"type": "number", "description": "Across"}}})");
    const json schema = jsonSchemaOf<Cart>();
    const json& properties = schema.at("properties");
    EXPECT_EQ(schema.at("required"), json({"wheels", "speed_m_s", "state"}));
    EXPECT_EQ(schema.at("additionalProperties"), false);
    EXPECT_EQ(properties.at("wheels"),
              json({{"type", "array"}, {"items", wheel}, {"description", "All of them"}}));
    EXPECT_EQ(properties.at("spare"), wheel);
    EXPECT_EQ(properties.at("speed_m_s").at("anyOf"),
              json::parse(R"([{"type": "number"}, {"type": "null"}])"));
    EXPECT_EQ(properties.at("state"), json::parse(R"({"enum": ["moves", "stands"]})"));
    EXPECT_TRUE(properties.contains("reasons"));
}

}  // namespace
}  // namespace kaustik::test
