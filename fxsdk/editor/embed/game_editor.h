/// @file game_editor.h
/// The effect editor as a window inside of a game: the game compiles it with its own ImGui (1.86 or later) by
/// fxsdk_add_editor() of the CMake package. This header includes neither ImGui nor OpenGL.
///
/// The renderer of ImGui must be that of OpenGL, whose ImTextureID is the name of a texture. The editor draws
/// its picture in the current context of OpenGL 4.5, through an fxsdk context of its own; states of OpenGL
/// are put back.
///
/// Threads: [GL thread].
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace fx::editor {

class EmbeddedEditor;

class GameEditor
{
public:
    /// How a game finds functions of OpenGL, as FxGlLoader of the C API.
    using FindFunction = void* (*)(void* user, const char* name);

    /// Opens a preset (*.fx.json), a scene (*.scene.json) or library:NAME. Needs a current context of OpenGL
    /// and of ImGui.
    /// @param recovery folder of recovery files; empty: that of fx edit
    /// @param outError receives what is wrong where the result is null
    static std::unique_ptr<GameEditor> open(const std::string& file, const std::string& recovery,
                                            FindFunction find, void* user, std::string& outError);
    ~GameEditor(); ///< ends like a crash: edits that are not saved are offered by the next open()
    GameEditor(const GameEditor&) = delete;
    GameEditor& operator=(const GameEditor&) = delete;

    /// Draws the panels into a rectangle of the display, between ImGui::NewFrame() and ImGui::Render().
    /// Space, Ctrl+Z, Ctrl+Y and Ctrl+S are keys of the editor while it is drawn.
    /// @param seconds [s] real time since the last frame
    /// @param x, y, width, height [pixel] at least 640 x 480
    void draw(double seconds, float x, float y, float width, float height);

    /// Goes to a time of the timeline [s].
    void scrub(double seconds);
    /// Shows each valid edit in a running game, also in this one, by its live link. @param address of
    /// fx_livelink.h; empty: the only game that is running @return what is wrong; empty: nothing
    std::string link(const std::string& address);
    /// Writes the file. @return what is wrong; empty: nothing
    std::string save();
    /// Whether there are edits that are not saved.
    bool isDirty() const;
    /// The text that save() writes.
    std::string text() const;
    /// Particles alive in the last picture.
    uint32_t particles() const;
    /// Forgets edits that are not saved: no recovery file of them is left. What an earlier session left stays
    /// until it was answered.
    void close();

private:
    GameEditor() = default;

    std::unique_ptr<EmbeddedEditor> editor_;
};

} // namespace fx::editor
