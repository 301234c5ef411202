#include "fxsdk/cli/support/atomic_file.h"
#include "tests/tool/temporary_folder.h"

namespace fx::cli {
namespace {

using test::TemporaryFolder;

TEST(AtomicFile, committingPutsExactlyTheWrittenBytesInPlace)
{
    TemporaryFolder folder;
    const std::string bytes("a\0b\n", 4);
    ASSERT_TRUE(writeFileAtomically(folder / "out.bin", bytes).ok());
    EXPECT_EQ(test::readText(folder / "out.bin"), bytes);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, withoutCommitNothingRemainsAndTheOldFileIsUntouched)
{
    TemporaryFolder folder;
    test::writeText(folder / "out.bin", "old");
    {
        AtomicFile file(folder / "out.bin");
        ASSERT_TRUE(file.open().ok());
        ASSERT_TRUE(file.write("half of the new").ok());
        EXPECT_EQ(test::readText(folder / "out.bin"), "old");
    }
    EXPECT_EQ(test::readText(folder / "out.bin"), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, aFullDiskIsAnErrorAndNotASuccess)
{
    const base::Status status = writeFileAtomically("/dev/full", "anything");
    EXPECT_EQ(status.code(), base::Code::Io);
    EXPECT_NE(status.message().find("/dev/full"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(AtomicFile, aMissingFolderIsNamed)
{
    TemporaryFolder folder;
    const base::Status status = writeFileAtomically(folder / "missing" / "out.bin", "x");
    EXPECT_EQ(status.code(), base::Code::Io);
    EXPECT_NE(status.message().find("missing/out.bin"), std::string::npos);
}

TEST(AtomicFile, aTargetThatIsAFolderIsRefusedAndStays)
{
    TemporaryFolder folder;
    std::filesystem::create_directory(folder / "out.png");
    EXPECT_FALSE(writeFileAtomically(folder / "out.png", "x").ok());
    EXPECT_TRUE(std::filesystem::is_directory(folder / "out.png"));
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, whatWouldFailAtTheEndIsFoundBefore)
{
    TemporaryFolder folder;
    EXPECT_TRUE(checkTarget(folder / "out.csv").ok());
    EXPECT_TRUE(checkTarget("out.csv").ok());
    EXPECT_NE(checkTarget(folder / "missing" / "out.csv").message().find("missing/out.csv"),
              std::string::npos);
    std::filesystem::create_directory(folder / "taken");
    EXPECT_EQ(checkTarget(folder / "taken").code(), base::Code::Io);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, theTemporaryNameKeepsFolderAndSuffix)
{
    const std::filesystem::path name = temporaryNameFor("some/folder/film.mp4");
    EXPECT_EQ(name.parent_path(), "some/folder");
    EXPECT_EQ(name.extension(), ".mp4");
    EXPECT_NE(name.filename(), "film.mp4");
}

} // namespace
} // namespace fx::cli
