#include "fxsdk/cli/support/ffmpeg_pipe.h"
#include "tests/tool/temporary_folder.h"

#include <csignal>
#include <cstdlib>
#include <vector>

namespace fx::cli {
namespace {

using test::TemporaryFolder;

/// Sets PATH for one test.
class PathScope
{
public:
    explicit PathScope(const std::string& path) : old_(std::getenv("PATH"))
    {
        setenv("PATH", path.c_str(), 1);
    }
    ~PathScope() { setenv("PATH", old_.c_str(), 1); }

private:
    std::string old_;
};

/// A program called ffmpeg that does what `script` says; `$out` is its last argument.
void installFake(const TemporaryFolder& folder, const std::string& script)
{
    test::writeText(folder / "ffmpeg",
                    "#!/bin/sh\nfor out in \"$@\"; do :; done\nout=${out#file:}\n" + script);
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
}

const std::vector<uint8_t> kFrame(4 * 2 * 3, 9);

class FfmpegPipeTest : public ::testing::Test
{
protected:
    void SetUp() override { std::signal(SIGPIPE, SIG_DFL); } // as in a game
    TemporaryFolder programs;
    TemporaryFolder folder;
    std::string path = programs.path().string() + ":/usr/bin:/bin";
};

TEST_F(FfmpegPipeTest, everyFrameReachesTheProgramInOrder)
{
    installFake(programs, "cat > \"$out\"\n");
    PathScope scope(path);
    FfmpegPipe pipe;
    ASSERT_TRUE(pipe.start(folder / "a.mp4", 4, 2, 30.0).ok());
    ASSERT_TRUE(pipe.write(kFrame).ok());
    ASSERT_TRUE(pipe.write(kFrame).ok());
    ASSERT_TRUE(pipe.finish().ok());
    EXPECT_EQ(test::readText(folder / "a.mp4"), std::string(48, '\x09'));
    EXPECT_EQ(folder.entries(), 1u);
}

TEST_F(FfmpegPipeTest, withoutFinishNoFileRemains)
{
    installFake(programs, "cat > \"$out\"\n");
    PathScope scope(path);
    {
        FfmpegPipe pipe;
        ASSERT_TRUE(pipe.start(folder / "a.mp4", 4, 2, 30.0).ok());
        ASSERT_TRUE(pipe.write(kFrame).ok());
    }
    EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(FfmpegPipeTest, aProgramThatFailsIsAnErrorAndLeavesNoFile)
{
    installFake(programs, "cat > \"$out\"; exit 3\n");
    PathScope scope(path);
    FfmpegPipe pipe;
    ASSERT_TRUE(pipe.start(folder / "a.mp4", 4, 2, 30.0).ok());
    EXPECT_EQ(pipe.finish().code(), base::Code::Io);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4"));
}

TEST_F(FfmpegPipeTest, aProgramThatStopsReadingIsAnErrorAndNotASignal)
{
    installFake(programs, "exec <&-; exit 0\n");
    PathScope scope(path);
    FfmpegPipe pipe;
    ASSERT_TRUE(pipe.start(folder / "a.mp4", 512, 512, 30.0).ok());
    const std::vector<uint8_t> large(512 * 512 * 3, 1); // more than a pipe holds
    EXPECT_EQ(pipe.write(large).code(), base::Code::Io);
}

TEST_F(FfmpegPipeTest, withoutTheProgramTheMessageSaysHowToGetIt)
{
    PathScope scope(folder.path().string());
    FfmpegPipe pipe;
    const base::Status status = pipe.start(folder / "a.mp4", 4, 2, 30.0);
    EXPECT_EQ(status.code(), base::Code::NotFound);
    EXPECT_NE(status.message().find("apt-get install ffmpeg"), std::string::npos);
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
} // namespace fx::cli
