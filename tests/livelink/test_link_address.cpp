#include "fxsdk/livelink/protocol/link_address.h"
#include "fxsdk/livelink/protocol/link_socket.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

using namespace fx::link;
using fx::base::Code;

namespace {

/// A folder as $XDG_RUNTIME_DIR while it exists.
class RuntimeFolder
{
public:
    RuntimeFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "fx-run-XXXXXX").string();
        path = mkdtemp(name.data());
        if (const char* const old = std::getenv("XDG_RUNTIME_DIR"))
            before_ = old;
        setenv("XDG_RUNTIME_DIR", path.c_str(), 1);
    }
    ~RuntimeFolder()
    {
        before_.empty() ? unsetenv("XDG_RUNTIME_DIR") : setenv("XDG_RUNTIME_DIR", before_.c_str(), 1);
        std::error_code error;
        std::filesystem::remove_all(path, error);
    }
    std::string path;

private:
    std::string before_;
};

} // namespace

TEST(LinkAddress, isReadInAllItsForms)
{
    for (const char* text : {"tcp:127.0.0.1:4711", "tcp:4711"}) {
        const auto tcp = parseAddress(text);
        ASSERT_TRUE(tcp.ok()) << text;
        EXPECT_EQ(toString(*tcp), "tcp:127.0.0.1:4711");
    }
    EXPECT_EQ(toString(*parseAddress("unix:/run/a.sock")), "unix:/run/a.sock");
    EXPECT_EQ(toString(*parseAddress("/run/a.sock")), "unix:/run/a.sock");
    for (const char* text : {"tcp:0", "tcp:65536", "tcp:10.0.0.1:80", "tcp:", "tcp:12x", ""})
        EXPECT_EQ(parseAddress(text).status().code(), Code::InvalidArgument) << text;
}

TEST(LinkAddress, aNameIsThatOfARunningGame)
{
    const RuntimeFolder runtime;
    const std::string folder = linkFolder();
    EXPECT_EQ(folder, runtime.path + "/fxsdk");
    EXPECT_EQ(parseAddress("game").status().code(), Code::NotFound);
    ASSERT_TRUE(makePrivateFolder(folder).ok());
    const std::string pid = std::to_string(getpid());
    Address one{folder + "/my-game-" + pid + ".sock", 0};
    Address ended{folder + "/gone-2147483646.sock", 0};
    Address another{folder + "/another-" + pid + ".sock", 0};
    const auto first = Socket::listen(one), second = Socket::listen(ended), third = Socket::listen(another);
    ASSERT_TRUE(first.ok() && second.ok() && third.ok());
    const auto games = findGames();
    ASSERT_EQ(games.size(), 2u);
    EXPECT_EQ(games[0].name, "another");
    EXPECT_EQ(games[1].name, "my-game");
    EXPECT_EQ(games[1].pid, getpid());
    EXPECT_EQ(parseAddress("my-game")->path, one.path);
    EXPECT_EQ(parseAddress("my-game-" + pid)->path, one.path);
    EXPECT_NE(parseAddress("other").status().message().find("my-game"), std::string::npos);
}

TEST(LinkAddress, theFolderAndTheSocketAreForThisUserOnly)
{
    const RuntimeFolder runtime;
    const std::string folder = linkFolder();
    ASSERT_TRUE(makePrivateFolder(folder).ok());
    struct stat facts
    {};
    ASSERT_EQ(stat(folder.c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777, 0700u);
    Address address{folder + "/a-1.sock", 0};
    const auto socket = Socket::listen(address);
    ASSERT_TRUE(socket.ok());
    ASSERT_EQ(stat(address.path.c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0077, 0u);
    ASSERT_EQ(chmod(folder.c_str(), 0750), 0);
    EXPECT_EQ(makePrivateFolder(folder).code(), Code::Io);
    EXPECT_EQ(makePrivateFolder(address.path).code(), Code::Io); // no folder
    EXPECT_EQ(makePrivateFolder(runtime.path + "/a/b").code(), Code::Io);
}

TEST(LinkSocket, theFileOfAnEndedProcessIsReplacedAndThatOfALivingOneIsNot)
{
    const RuntimeFolder runtime;
    Address address{runtime.path + "/a.sock", 0};
    {
        const auto ended = Socket::listen(address);
        ASSERT_TRUE(ended.ok());
    } // the file stays
    EXPECT_TRUE(std::filesystem::exists(address.path));
    EXPECT_EQ(Socket::connect(address).status().code(), Code::NotFound);
    const auto living = Socket::listen(address);
    ASSERT_TRUE(living.ok()) << living.status().message();
    EXPECT_EQ(Socket::listen(address).status().code(), Code::Io);
    Address tooLong{runtime.path + "/" + std::string(200, 'a'), 0};
    EXPECT_EQ(Socket::listen(tooLong).status().code(), Code::InvalidArgument);
}

TEST(LinkAddress, namesOfGamesHaveNoSlashesAndBlanks)
{
    EXPECT_TRUE(isGameName("my-game_2.1"));
    for (const std::string name : {"", "a b", "../a", ".a", "a/b"})
        EXPECT_FALSE(isGameName(name)) << name;
    EXPECT_FALSE(isGameName(std::string(65, 'a')));
}
