// SPDX-License-Identifier: MIT
// Which device a context is made on, on machines with several that EGL lists.
#include <gtest/gtest.h>

#include <map>

#include "framework/core/error.h"
#include "framework/gl/egl_devices.h"

namespace kaustik::gl {
namespace {

EglDevice processor(int index, int cuda, const std::string& uuid) {
    EglDevice device;
    device.index = index;
    device.cuda = cuda;
    device.uuid = uuid;
    return device;
}

// Two graphics processors, which CUDA counts the other way round, and Mesa's stand-in.
std::vector<EglDevice> machine() {
    EglDevice software;
    software.index = 2;
    software.isSoftware = true;
    return {processor(0, 1, "aaaa0000-1111-2222-3333-444444444444"),
            processor(1, 0, "bbbb0000-1111-2222-3333-444444444444"), software};
}

GivenDevices givenBy(const std::string& text) {
    return givenDevices([&](const char* name) -> const char* {
        return name == std::string("CUDA_VISIBLE_DEVICES") ? text.c_str() : nullptr;
    });
}

const GivenDevices kUnspecified;

std::vector<int> indices(const std::vector<EglDevice>& devices) {
    std::vector<int> numbers;
    for (const EglDevice& device : devices)
        numbers.push_back(device.index);
    return numbers;
}

std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(GivenDevices, AreReadAsCudaReadsThem) {
    EXPECT_FALSE(givenDevices([](const char*) { return nullptr; }).isExplicit());
    EXPECT_EQ(givenBy("2, 0").entries, (std::vector<std::string>{"2", "0"}));
    EXPECT_EQ(givenBy("GPU-bbbb,1").entries, (std::vector<std::string>{"GPU-bbbb", "1"}));
    EXPECT_EQ(givenBy("1,-1,0").entries, (std::vector<std::string>{"1"}));
    EXPECT_TRUE(givenBy("").isExplicit());
    EXPECT_TRUE(givenBy("").entries.empty());
    EXPECT_TRUE(givenBy("NoDevFiles").entries.empty());
}

TEST(DeviceChoice, TakesAGraphicsProcessorBeforeWhatStandsInForOne) {
    EXPECT_EQ(indices(inPreferenceOrder(machine(), kUnspecified)), (std::vector<int>{0, 1, -1, 2}));
    EXPECT_EQ(indices(inPreferenceOrder({}, kUnspecified)), (std::vector<int>{-1}));
}

TEST(DeviceChoice, TakesWhatTheJobWasGiven) {
    EXPECT_EQ(indices(inPreferenceOrder(machine(), givenBy("0"))), (std::vector<int>{1, -1, 2}));
    EXPECT_EQ(indices(inPreferenceOrder(machine(), givenBy("1"))), (std::vector<int>{0, -1, 2}));
    EXPECT_EQ(indices(inPreferenceOrder(machine(), givenBy("GPU-BBBB"))),
              (std::vector<int>{1, -1, 2}));
    // None at all: the processor.
    EXPECT_EQ(indices(inPreferenceOrder(machine(), givenBy("-1"))), (std::vector<int>{-1, 2}));
}

TEST(DeviceChoice, KeepsDevicesOfWhichNobodyCanTell) {
    EglDevice other;  // of a vendor that CUDA does not count
    other.index = 0;
    EXPECT_EQ(indices(inPreferenceOrder({other}, givenBy("0"))), (std::vector<int>{0, -1}));
    EXPECT_EQ(indices(inPreferenceOrder({other, machine()[1]}, givenBy("0"))),
              (std::vector<int>{1, 0, -1}));
}

TEST(DeviceChoice, RefusesAJobWhoseDevicesEglDoesNotList) {
    const std::string message =
        refusal([] { static_cast<void>(inPreferenceOrder(machine(), givenBy("5"))); });
    EXPECT_NE(message.find("CUDA_VISIBLE_DEVICES=5 gives this job no device"), std::string::npos)
        << message;
}

TEST(DeviceWanted, IsFoundByNumberAndUuid) {
    EXPECT_EQ(indices(matchingDevices(machine(), "1", kUnspecified)), (std::vector<int>{1}));
    EXPECT_EQ(indices(matchingDevices(machine(), "aaaa0000", kUnspecified)), (std::vector<int>{0}));
    EXPECT_EQ(indices(matchingDevices(machine(), "GPU-bbbb0", kUnspecified)),
              (std::vector<int>{1}));
    // What may be a name is for a context to tell.
    EXPECT_TRUE(matchingDevices(machine(), "Quadro", kUnspecified).empty());
}

TEST(DeviceWanted, MustBeThereAndGivenToTheJob) {
    const std::string missing =
        refusal([] { static_cast<void>(matchingDevices(machine(), "7", kUnspecified)); });
    EXPECT_NE(missing.find("there is no device 7"), std::string::npos) << missing;
    for (const char* wanted : {"0", "GPU-aaaa"}) {
        const std::string message =
            refusal([&] { static_cast<void>(matchingDevices(machine(), wanted, givenBy("0"))); });
        EXPECT_NE(message.find("device 0"), std::string::npos) << message;
        EXPECT_NE(message.find("CUDA_VISIBLE_DEVICES=0"), std::string::npos) << message;
    }
    // What renders on the processor is nobody's to give.
    EXPECT_EQ(indices(matchingDevices(machine(), "2", givenBy("0"))), (std::vector<int>{2}));
}

}  // namespace
}  // namespace kaustik::gl
