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

    /// Draws a frame that sees `events`.
    ImGuiIO& frame(const std::vector<InputEvent>& events)
    {
        applyInput(events);
        ImGui::NewFrame();
        seen_ = ImGui::GetIO(); // EndFrame() forgets the wheel
        ImGui::EndFrame();
        return seen_;
    }

private:
    ImGuiIO seen_;
};

TEST_F(Input, eachModifierIsSeenOnBothSidesOfTheKeyboard)
{
    constexpr int kFirstLeft = 340, kFirstRight = 344; // of GLFW: shift, control, alt, super
    for (const int first : {kFirstLeft, kFirstRight})
        for (int i = 0; i < 4; ++i) {
            for (const bool isDown : {true, false}) {
                const ImGuiIO& io = frame({{InputKind::Key, first + i, isDown, 0.0, 0.0}});
                EXPECT_EQ(io.KeyShift, isDown && i == 0) << first + i;
                EXPECT_EQ(io.KeyCtrl, isDown && i == 1) << first + i;
                EXPECT_EQ(io.KeyAlt, isDown && i == 2) << first + i;
                EXPECT_EQ(io.KeySuper, isDown && i == 3) << first + i;
            }
        }
}

TEST_F(Input, bothDirectionsOfTheWheelAreSeen)
{
    const ImGuiIO& io = frame({{InputKind::Wheel, 0, false, 2.0, -3.0}});
    EXPECT_EQ(io.MouseWheelH, 2.0f);
    EXPECT_EQ(io.MouseWheel, -3.0f);
}

} // namespace
} // namespace fx::editor
