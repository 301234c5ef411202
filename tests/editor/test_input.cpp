// What ImGui sees of events.
#include "fxsdk/editor/program/input.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace fx::editor {
namespace {

/// A context of ImGui without a window.
class Input : public ::testing::Test
{
protected:
    Input()
    {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {640.0f, 480.0f};
        io.IniFilename = nullptr;
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        startInput();
        frame({});
    }
    ~Input() override { ImGui::DestroyContext(); }

    struct Seen
    {
        bool shift, control, alt, super;
        float wheel, wheelH;
    };

    /// Draws a frame that sees `events`.
    static Seen frame(const std::vector<InputEvent>& events)
    {
        applyInput(events);
        ImGui::NewFrame();
        const ImGuiIO& io = ImGui::GetIO(); // EndFrame() forgets the wheel
        const Seen seen{io.KeyShift, io.KeyCtrl, io.KeyAlt, io.KeySuper, io.MouseWheel, io.MouseWheelH};
        ImGui::EndFrame();
        return seen;
    }
};

TEST_F(Input, eachModifierIsSeenOnBothSidesOfTheKeyboard)
{
    constexpr int kFirstLeft = 340, kFirstRight = 344; // of GLFW: shift, control, alt, super
    for (const int first : {kFirstLeft, kFirstRight})
        for (int i = 0; i < 4; ++i) {
            for (const bool isDown : {true, false}) {
                const Seen seen = frame({{InputKind::Key, first + i, isDown, 0.0, 0.0}});
                EXPECT_EQ(seen.shift, isDown && i == 0) << first + i;
                EXPECT_EQ(seen.control, isDown && i == 1) << first + i;
                EXPECT_EQ(seen.alt, isDown && i == 2) << first + i;
                EXPECT_EQ(seen.super, isDown && i == 3) << first + i;
            }
        }
}

TEST_F(Input, bothDirectionsOfTheWheelAreSeen)
{
    const Seen seen = frame({{InputKind::Wheel, 0, false, 2.0, -3.0}});
    EXPECT_EQ(seen.wheelH, 2.0f);
    EXPECT_EQ(seen.wheel, -3.0f);
}

} // namespace
} // namespace fx::editor
