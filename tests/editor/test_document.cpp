#include "fxsdk/editor/document/document.h"

#include "fxsdk/presets/preset_loader.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

#include <random>

namespace fx::editor {
namespace {

const std::string kText = R"({
  "version": 1,
  "name": "two",
  "emitters": [
    {"name": "a", "lifetime": 2, "future": {"unknown": [1, 2]}},
    {"name": "b", "size": 0.50}
  ]
}
)";

Document documentOf(const std::string& text, const std::string& path = "two.fx.json")
{
    auto document = Document::fromText(text, path);
    EXPECT_TRUE(document.ok()) << document.status().message();
    return std::move(*document);
}

TEST(Document, aNewMemberGetsItsPlaceInTheSchema)
{
    Document document = documentOf(kText);
    ASSERT_TRUE(document.set("/duration", 3).ok());
    std::vector<std::string> names;
    for (auto it = document.json().begin(); it != document.json().end(); ++it)
        names.push_back(it.key());
    EXPECT_EQ(names, (std::vector<std::string>{"version", "name", "duration", "emitters"}));
}

TEST(Document, absentObjectsAroundAMemberAreCreated)
{
    Document document = documentOf(kText);
    ASSERT_TRUE(document.set("/emitters/0/forces/drag", 2).ok());
    EXPECT_EQ(document.json()["emitters"][0]["forces"], (Json{{"drag", 2}}));
    ASSERT_TRUE(document.undo());
    EXPECT_FALSE(document.json()["emitters"][0].contains("forces"));
}

TEST(Document, unknownMembersAreSaved)
{
    test::TemporaryFolder folder;
    test::writeText(folder / "two.fx.json", kText);
    auto document = Document::open((folder / "two.fx.json").string());
    ASSERT_TRUE(document.ok());
    ASSERT_TRUE(document->set("/emitters/1/size", 2).ok());
    ASSERT_TRUE(document->save().ok());
    const std::string saved = test::readText(folder / "two.fx.json");
    EXPECT_NE(saved.find(R"({"name": "a", "lifetime": 2, "future": {"unknown": [1, 2]}})"),
              std::string::npos);
    EXPECT_NE(saved.find(R"("size": 2})"), std::string::npos);
    EXPECT_FALSE(document->isDirty());
}

TEST(Document, everyLibraryPresetIsSavedUnchanged)
{
    test::TemporaryFolder folder;
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        Document document = documentOf(std::string(file.text), (folder / std::string(file.name)).string());
        ASSERT_TRUE(document.save().ok());
        EXPECT_EQ(test::readText(folder / std::string(file.name)), file.text) << file.name;
    }
}

TEST(Document, elementsAreMovedAndDuplicated)
{
    Document document = documentOf(kText);
    ASSERT_TRUE(document.duplicate("/emitters", 0).ok());
    EXPECT_EQ(document.json()["emitters"][1]["name"], "a 2");
    EXPECT_EQ(document.json()["emitters"][1]["future"], document.json()["emitters"][0]["future"]);
    ASSERT_TRUE(document.move("/emitters", 2, 0).ok());
    EXPECT_EQ(document.json()["emitters"][0]["name"], "b");
    ASSERT_TRUE(document.erase("/emitters/0").ok());
    EXPECT_EQ(document.json()["emitters"].size(), 2u);
    EXPECT_EQ(document.move("/emitters", 0, 2).code(), base::Code::InvalidArgument);
    EXPECT_EQ(document.erase("/emitters/7").code(), base::Code::NotFound);
    while (document.undo()) {
    }
    EXPECT_EQ(document.text(), kText);
}

TEST(Document, aWrongPointerIsRefusedAndChangesNothing)
{
    Document document = documentOf(kText);
    EXPECT_EQ(document.set("/emitters/5/size", 1).code(), base::Code::InvalidArgument);
    EXPECT_EQ(document.set("/name/x", 1).code(), base::Code::InvalidArgument);
    EXPECT_EQ(document.insert("/name", 0, 1).code(), base::Code::InvalidArgument);
    EXPECT_FALSE(document.history().canUndo());
    EXPECT_EQ(document.text(), kText);
}

TEST(Document, aDragIsOneEdit)
{
    Document document = documentOf(kText);
    for (int i = 1; i <= 20; ++i)
        ASSERT_TRUE(document.set("/emitters/1/size", i, 5).ok());
    EXPECT_EQ(document.history().edits().size(), 1u);
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.text(), kText);
    ASSERT_TRUE(document.redo());
    EXPECT_EQ(document.json()["emitters"][1]["size"], 20);
}

TEST(Document, aDragThatAddsAMemberIsOneEdit)
{
    Document document = documentOf(kText);
    for (int i = 1; i <= 20; ++i)
        ASSERT_TRUE(document.set("/emitters/0/forces/drag", i, 9).ok());
    EXPECT_EQ(document.json()["emitters"][0]["forces"]["drag"], 20);
    EXPECT_EQ(document.history().edits().size(), 1u);
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.text(), kText);
}

/// One of the commands, with arguments that may be wrong.
void editAtRandom(Document& io, std::mt19937& chance)
{
    const auto below = [&](size_t n) { return size_t(chance() % n); };
    const std::string element = "/emitters/" + std::to_string(below(4));
    switch (below(6)) {
    case 0:
        return (void)io.set(element + "/size", double(below(100)) / 8);
    case 1:
        return (void)io.set(element + "/forces/drag", below(9));
    case 2:
        return (void)io.erase(element + "/size");
    case 3:
        return (void)io.duplicate("/emitters", below(4));
    case 4:
        return (void)io.move("/emitters", below(4), below(4));
    default:
        return (void)(io.json()["emitters"].size() > 1 ? io.erase(element) : base::Status());
    }
}

TEST(Document, undoOfAThousandRandomEditsRestoresEveryState)
{
    Document document = documentOf(kText);
    std::mt19937 chance(7);
    std::vector<std::string> states{document.text()};
    while (document.history().edits().size() < 1000) {
        const size_t before = document.history().edits().size();
        editAtRandom(document, chance);
        if (document.history().edits().size() > before)
            states.push_back(document.text());
    }
    for (size_t i = states.size(); i-- > 1;) {
        EXPECT_EQ(document.text(), states[i]);
        ASSERT_TRUE(document.undo());
    }
    EXPECT_EQ(document.text(), kText);
    EXPECT_FALSE(document.isDirty());
    for (size_t i = 1; i < states.size(); ++i) {
        ASSERT_TRUE(document.redo());
        EXPECT_EQ(document.text(), states[i]);
    }
    EXPECT_FALSE(document.redo());
}

TEST(Document, aFileThatChangedOutsideIsNotOverwritten)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "two.fx.json").string();
    test::writeText(path, kText);
    auto document = Document::open(path);
    ASSERT_TRUE(document.ok());
    ASSERT_TRUE(document->set("/name", "mine").ok());
    test::writeText(path, R"({"version": 1, "name": "theirs"})");
    EXPECT_EQ(document->save().code(), base::Code::InvalidArgument);
    EXPECT_EQ(test::readText(path), R"({"version": 1, "name": "theirs"})");
    ASSERT_TRUE(document->save(true).ok());
    EXPECT_NE(test::readText(path).find("mine"), std::string::npos);
}

TEST(Document, aReloadCanBeUndone)
{
    Document document = documentOf(kText);
    ASSERT_TRUE(document.set("/name", "mine").ok());
    ASSERT_TRUE(document.reload(R"({"version": 1, "name": "theirs"})").ok());
    EXPECT_EQ(document.json()["name"], "theirs");
    EXPECT_FALSE(document.isDirty());
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.json()["name"], "mine");
    EXPECT_TRUE(document.isDirty());
    EXPECT_EQ(document.reload("{").code(), base::Code::Parse);
    EXPECT_EQ(document.json()["name"], "mine");
}

TEST(Document, textThatIsNotJsonIsRefusedWithItsPlace)
{
    const auto document = Document::fromText("{\n  \"version\" 1\n}", "bad.fx.json");
    ASSERT_FALSE(document.ok());
    EXPECT_NE(document.status().message().find("bad.fx.json:2:"), std::string::npos);
    EXPECT_FALSE(Document::fromText("[1]", "bad.fx.json").ok());
    EXPECT_EQ(Document::open("no-such-file.fx.json").status().code(), base::Code::NotFound);
}

TEST(Document, aPresetOfTheLibraryHasNoFileUntilItIsSavedAs)
{
    test::TemporaryFolder folder;
    auto document = Document::open("library:campfire");
    ASSERT_TRUE(document.ok());
    EXPECT_EQ(document->save().code(), base::Code::InvalidArgument);
    ASSERT_TRUE(document->saveAs((folder / "mine.fx.json").string()).ok());
    EXPECT_EQ(document->path(), (folder / "mine.fx.json").string());
    EXPECT_EQ(document->saveAs((folder / "mine.scene.json").string()).code(), base::Code::InvalidArgument);
}

} // namespace
} // namespace fx::editor
