#include "fxsdk/editor/document/file_watch.h"

#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

TEST(FileWatch, tellsAChangeOnce)
{
    test::TemporaryFolder folder;
    const auto path = folder / "a.fx.json";
    test::writeText(path, "one");
    FileWatch watch(path, std::chrono::milliseconds(0));
    EXPECT_FALSE(watch.changedText("one").has_value());
    test::writeText(path, "another");
    EXPECT_EQ(watch.changedText("one"), "another");
    EXPECT_FALSE(watch.changedText("one").has_value());
}

TEST(FileWatch, aWriteOfTheKnownTextIsNoChange)
{
    test::TemporaryFolder folder;
    const auto path = folder / "a.fx.json";
    test::writeText(path, "one");
    FileWatch watch(path, std::chrono::milliseconds(0));
    std::filesystem::remove(path);
    EXPECT_FALSE(watch.changedText("one").has_value());
    test::writeText(path, "one");
    EXPECT_FALSE(watch.changedText("one").has_value());
}

TEST(FileWatch, aFileThatIsReplacedByAnotherIsRead)
{
    test::TemporaryFolder folder;
    const auto path = folder / "a.fx.json";
    test::writeText(path, "one");
    FileWatch watch(path, std::chrono::milliseconds(0));
    test::writeText(folder / "b", "two");
    std::filesystem::rename(folder / "b", path);
    EXPECT_EQ(watch.changedText("one"), "two");
}

} // namespace
} // namespace fx::editor
