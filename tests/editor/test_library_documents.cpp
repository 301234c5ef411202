/// Presets of the library are the same effects after the editor has opened, edited, undone and saved them.

#include "fxsdk/editor/document/document.h"
#include "fxsdk/fxsdk.hpp"
#include "fxsdk/presets/preset_loader.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

/// State of an instance after half a second.
uint64_t stateHash(const std::string& text, const std::string& name)
{
    fxsdk::Context context;
    fxsdk::Scene scene(context);
    scene.create(context.loadText(text, name));
    for (int i = 0; i < 30; ++i)
        scene.update(1.0 / 60.0);
    uint64_t hash = 0;
    fxsdk::check(fxScene_GetStateHash(scene.get(), &hash));
    return hash;
}

TEST(LibraryDocuments, everyPresetHasTheSameStateHashAfterASave)
{
    test::TemporaryFolder folder;
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        const std::string name(file.name);
        const std::string path = (folder / name).string();
        test::writeText(path, std::string(file.text));
        auto document = Document::open(path);
        ASSERT_TRUE(document.ok()) << name;
        ASSERT_TRUE(document->set("/bound", 12).ok());
        ASSERT_TRUE(document->save().ok());
        ASSERT_TRUE(document->undo());
        ASSERT_TRUE(document->save().ok());
        const std::string saved = test::readText(path);
        EXPECT_EQ(Json::parse(saved), Json::parse(file.text)) << name;
        EXPECT_EQ(stateHash(saved, name), stateHash(std::string(file.text), name)) << name;
    }
}

} // namespace
} // namespace fx::editor
