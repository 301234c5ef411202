/// Presets of the library show the same picture after the editor has opened and saved them. The picture is
/// that of fx render.

#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/editor/session/session.h"
#include "fxsdk/presets/preset_loader.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace fx::editor {
namespace {

constexpr double kMoment = 0.2; // [s] what follows costs time and shows nothing else of a text
constexpr int kWidth = 96;      // [pixel]
constexpr int kHeight = 54;     // [pixel]

/// RGBA of the picture of a preset; empty if it failed.
std::vector<float> pictureOf(const std::string& path)
{
    auto scene = cli::sceneOfPreset(path);
    EXPECT_TRUE(scene.ok()) << path << ": " << scene.status().message();
    if (!scene.ok())
        return {};
    scene->view.composition = render::Composition::Sorted; // fields of media take many times longer
    cli::FrameRendererOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.settings = scene->view;
    options.scene.quality = FX_QUALITY_LOW;
    auto renderer = cli::FrameRenderer::create(*scene, options);
    EXPECT_TRUE(renderer.ok()) << path << ": " << renderer.status().message();
    if (!renderer.ok())
        return {};
    const base::Status status = (*renderer)->render(base::toTicks(kMoment));
    EXPECT_TRUE(status.ok()) << path << ": " << status.message();
    auto layers = (*renderer)->read();
    EXPECT_TRUE(layers.ok()) << path;
    return layers.ok() ? layers->color.pixels : std::vector<float>();
}

/// Opens a file in the editor, lets `edit` change it, and saves it. @return the bytes of the file
template <class Edit>
std::string saved(const std::string& path, const test::TemporaryFolder& folder, Edit&& edit)
{
    auto session = Session::open(path, folder / "state");
    EXPECT_TRUE(session.ok()) << session.status().message();
    if (!session.ok())
        return {};
    for (const DocumentFinding& finding : (*session)->findings())
        EXPECT_TRUE(finding.diagnostic.warning) << path << ": " << finding.diagnostic.message;
    edit(**session);
    (*session)->save();
    EXPECT_EQ((*session)->message, "Saved " + path);
    (*session)->close();
    return test::readText(path);
}

TEST(LibraryPictures, everyPresetIsSavedAsTheSameBytesAndShowsTheSamePicture)
{
    constexpr size_t kDrawnEvery = 4; // texts and values of all are compared
    size_t number = 0;
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        test::TemporaryFolder folder;
        const std::string path = (folder / std::string(file.name)).string();
        test::writeText(path, std::string(file.text));
        const bool isDrawn = number++ % kDrawnEvery == 0;
        const std::vector<float> before = isDrawn ? pictureOf(path) : std::vector<float>();
        EXPECT_EQ(saved(path, folder, [](Session&) {}), file.text) << file.name;
        // An edit that no picture shows makes the editor write the text anew.
        const std::string edited = saved(path, folder, [](Session& session) {
            session.run(session.document.set("/description", "Opened and saved by the editor."));
        });
        EXPECT_NE(edited, file.text) << file.name;
        Json expected = Json::parse(file.text);
        expected["description"] = "Opened and saved by the editor.";
        EXPECT_EQ(Json::parse(edited), expected) << file.name;
        if (!isDrawn)
            continue;
        ASSERT_EQ(before.size(), size_t(4 * kWidth * kHeight)) << path;
        EXPECT_NE(std::adjacent_find(before.begin(), before.end(), std::not_equal_to<>()), before.end())
            << file.name << " is of one color";
        EXPECT_TRUE(pictureOf(path) == before) << file.name << " shows another picture after the save";
    }
    EXPECT_GT(number, kDrawnEvery);
}

TEST(LibraryPictures, aTextWithAnotherValueShowsAnotherPicture)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "campfire.fx.json").string();
    for (const base::EmbeddedText& file : preset::presetLibrary())
        if (file.name == "campfire.fx.json")
            test::writeText(path, std::string(file.text));
    const std::vector<float> before = pictureOf(path);
    (void)saved(path, folder, [](Session& session) {
        session.run(session.document.set("/emitters/0/position", Json::array({0.4, 0.2, 0.0})));
    });
    EXPECT_FALSE(pictureOf(path) == before);
}

} // namespace
} // namespace fx::editor
