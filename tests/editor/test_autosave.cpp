#include "fxsdk/editor/document/autosave.h"

#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

namespace fx::editor {
namespace {

constexpr auto kAtOnce = std::chrono::milliseconds(0);
const std::string kText = R"({"version": 1, "name": "old"})";

Document documentAt(const std::string& path)
{
    auto document = Document::open(path);
    EXPECT_TRUE(document.ok());
    return std::move(*document);
}

TEST(Autosave, aKilledProgramLeavesItsLastText)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, kText);
    const pid_t child = fork();
    if (child == 0) {
        Document document = documentAt(path);
        Autosave autosave(path, folder / "state");
        (void)document.set("/name", "new");
        (void)autosave.update(document, kAtOnce);
        raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    const Autosave autosave(path, folder / "state");
    ASSERT_TRUE(autosave.recoverable().has_value());
    EXPECT_EQ(*autosave.recoverable(), R"({"version": 1, "name": "new"})");
    EXPECT_EQ(test::readText(path), kText);
}

TEST(Autosave, theTextOfARunningProgramIsNotRecovered)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, kText);
    int written[2];
    ASSERT_EQ(pipe(written), 0);
    const pid_t child = fork();
    if (child == 0) {
        Document document = documentAt(path);
        Autosave autosave(path, folder / "state");
        (void)document.set("/name", "new");
        (void)autosave.update(document, kAtOnce);
        (void)!write(written[1], "x", 1);
        pause();
    }
    char done = 0;
    ASSERT_EQ(read(written[0], &done, 1), 1);
    const Autosave autosave(path, folder / "state");
    EXPECT_FALSE(autosave.recoverable().has_value());
    EXPECT_TRUE(autosave.isOpenElsewhere());
    Document document = documentAt(path);
    ASSERT_TRUE(document.set("/name", "mine").ok());
    Autosave second(path, folder / "state");
    EXPECT_FALSE(second.update(document, kAtOnce).ok()); // the text of the other is not overwritten,
    second.discard();                                    // nor removed
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(autosave.isOpenElsewhere());
    EXPECT_NE(autosave.recoverable().value_or("").find("new"), std::string::npos);
}

TEST(Autosave, aSavedDocumentLeavesNothing)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, kText);
    Document document = documentAt(path);
    Autosave autosave(path, folder / "state");
    ASSERT_TRUE(autosave.update(document, kAtOnce).ok());
    EXPECT_FALSE(std::filesystem::exists(autosave.file()));
    ASSERT_TRUE(document.set("/name", "new").ok());
    ASSERT_TRUE(autosave.update(document, kAtOnce).ok());
    EXPECT_TRUE(std::filesystem::exists(autosave.file()));
    ASSERT_TRUE(document.save().ok());
    ASSERT_TRUE(autosave.update(document, kAtOnce).ok());
    EXPECT_FALSE(std::filesystem::exists(autosave.file()));
}

TEST(Autosave, aDamagedFileIsIgnored)
{
    test::TemporaryFolder folder;
    const Autosave autosave("a.fx.json", folder.path());
    for (const char* text : {"", "{", "[]", R"({"path": "a"})", R"({"text": 1})"}) {
        test::writeText(autosave.file(), text);
        EXPECT_FALSE(autosave.recoverable().has_value()) << text;
    }
}

} // namespace
} // namespace fx::editor
