#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

using namespace fx::asset;
using fx::base::Code;
using fx::test::TempFolder;

namespace {

constexpr fx::base::EmbeddedText kLibrary[] = {{"spark.fx.json", "{}"}, {"fog.fx.json", "{\"a\":1}"}};

int codeOf(const AssetResolver& resolver, std::string_view name, uint64_t limit = 100)
{
    return int(resolver.read(name, limit).status().code());
}

/// A host that knows one asset, "packed".
int readPacked(void*, const char* name, uint64_t maxBytes, void (*deliver)(void*, const void*, size_t),
               void* sink)
{
    if (std::strcmp(name, "broken") == 0)
        return 3;
    if (std::strcmp(name, "packed") != 0)
        return 1;
    if (maxBytes < 4)
        return 2;
    deliver(sink, "host", 4);
    return 0;
}

} // namespace

TEST(AssetResolver, readsBelowItsFolder)
{
    const TempFolder folder;
    folder.write("a.txt", "A");
    folder.write("sub/b.txt", "B");
    const AssetResolver resolver(folder.path(), kLibrary);
    EXPECT_EQ(*resolver.read("a.txt", 100), "A");
    EXPECT_EQ(*resolver.read("sub/b.txt", 100), "B");
    EXPECT_EQ(*resolver.read("./sub//b.txt", 100), "B");
    EXPECT_EQ(codeOf(resolver, "c.txt"), int(Code::NotFound));
    EXPECT_EQ(codeOf(resolver, "sub"), int(Code::Io));
}

TEST(AssetResolver, tellsTheFileBehindANameThatIsOne)
{
    const TempFolder folder;
    folder.write("a.txt", "A");
    folder.write("inner/x.txt", "X");
    const AssetResolver resolver(folder.path() + "/inner", kLibrary);
    EXPECT_EQ(resolver.fileOf("./x.txt"),
              std::filesystem::canonical(folder.path() + "/inner/x.txt").string());
    for (const char* name : {"", "missing.txt", "../a.txt", "library:spark", "/etc/passwd"})
        EXPECT_EQ(resolver.fileOf(name), "") << name;
    EXPECT_EQ(AssetResolver(folder.path(), kLibrary, {nullptr, readPacked}).fileOf("a.txt"), "");
}

TEST(AssetResolver, refusesNamesThatLeadOut)
{
    const TempFolder folder;
    folder.write("a.txt", "A");
    folder.write("inner/x.txt", "X");
    const AssetResolver resolver(folder.path() + "/inner", kLibrary);
    for (const char* name : {"", "/etc/passwd", "../a.txt", "x/../../a.txt", "..", "sub/..", "C:/a.txt",
                             "..\\a.txt", "library:", "library:/a", "library:../spark", "a\nb"})
        EXPECT_EQ(codeOf(resolver, name), int(Code::InvalidArgument)) << name;
    EXPECT_EQ(codeOf(resolver, std::string(600, 'a')), int(Code::InvalidArgument));
    EXPECT_EQ(codeOf(resolver, "..x"), int(Code::NotFound)); // a name with dots, not a way out
}

TEST(AssetResolver, followsLinksThatStayInsideAndNoOthers)
{
    const TempFolder folder;
    folder.write("secret.txt", "S");
    folder.write("inner/x.txt", "X");
    folder.write("inner2/y.txt", "Y"); // shares the beginning of its name with the folder
    std::filesystem::create_symlink("x.txt", folder.path() + "/inner/good");
    std::filesystem::create_symlink("../secret.txt", folder.path() + "/inner/bad");
    std::filesystem::create_directory_symlink("../inner2", folder.path() + "/inner/out");
    std::filesystem::create_symlink("loop", folder.path() + "/inner/loop");
    const AssetResolver resolver(folder.path() + "/inner", kLibrary);
    EXPECT_EQ(*resolver.read("good", 100), "X");
    EXPECT_EQ(codeOf(resolver, "bad"), int(Code::InvalidArgument));
    EXPECT_EQ(codeOf(resolver, "out/y.txt"), int(Code::InvalidArgument));
    EXPECT_EQ(codeOf(resolver, "loop"), int(Code::NotFound));
}

TEST(AssetResolver, knowsTheLibraryByNameAndListsItWhenAskedInVain)
{
    const AssetResolver resolver("", kLibrary);
    EXPECT_EQ(*resolver.read("library:fog", 100), "{\"a\":1}");
    EXPECT_EQ(codeOf(resolver, "library:fog", 3), int(Code::TooLarge));
    const auto missing = resolver.read("library:frog", 100);
    EXPECT_EQ(int(missing.status().code()), int(Code::NotFound));
    EXPECT_NE(missing.status().message().find("spark fog"), std::string::npos);
    EXPECT_EQ(codeOf(resolver, "a.txt"), int(Code::NotFound));
}

TEST(AssetResolver, theHostComesBeforeTheFolderAndAfterTheRules)
{
    const TempFolder folder;
    folder.write("packed", "disk");
    folder.write("other", "disk");
    const AssetResolver resolver(folder.path(), kLibrary, {nullptr, readPacked});
    EXPECT_EQ(*resolver.read("packed", 100), "host");
    EXPECT_EQ(*resolver.read("other", 100), "disk");
    EXPECT_EQ(codeOf(resolver, "packed", 3), int(Code::TooLarge));
    EXPECT_EQ(codeOf(resolver, "broken"), int(Code::Io));
    EXPECT_EQ(codeOf(resolver, "../packed"), int(Code::InvalidArgument));
}

TEST(ReadFile, refusesBySizeBeforeReading)
{
    const TempFolder folder;
    const std::string path = folder.write("big", "");
    std::filesystem::resize_file(path, uint64_t(1) << 40); // a hole of 1 TiB: reading it would take hours
    EXPECT_EQ(int(readFile(path, 1000).status().code()), int(Code::TooLarge));
}

TEST(ReadFile, takesWholeFilesUpToTheLimitAndNothingElse)
{
    const TempFolder folder;
    const std::string path = folder.write("ten", "0123456789");
    EXPECT_EQ(*readFile(path, 10), "0123456789");
    EXPECT_EQ(int(readFile(path, 9).status().code()), int(Code::TooLarge));
    EXPECT_EQ(int(readFile("/dev/zero", 10).status().code()), int(Code::Io));
    EXPECT_EQ(int(readFile(folder.path(), 10).status().code()), int(Code::Io));
    EXPECT_EQ(int(readFile(path + "/x", 10).status().code()), int(Code::NotFound));
}
