/// The journal of finished tiles: what a killed, a broken and another picture's journal give back.

#include "rendering/reference/render/tile_journal.h"

#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sys/resource.h>
#include <unistd.h>

namespace fx::render {
namespace {

using Tiles = std::map<uint32_t, std::vector<float>>;

class TileJournalTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "fx-journal-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        path_ = (folder_ / "a.exr.journal").string();
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(uint64_t key, const Tiles& tiles)
    {
        TileJournal journal(path_, key);
        ASSERT_TRUE(journal.start().ok());
        for (const auto& [tile, values] : tiles)
            ASSERT_TRUE(journal.append(tile, values).ok());
    }

    base::Status read(uint64_t key, Tiles& out)
    {
        TileJournal journal(path_, key);
        return journal.resume([&](uint32_t tile, std::span<const float> values) {
            out[tile].assign(values.begin(), values.end());
        });
    }

    std::filesystem::path folder_;
    std::string path_;
};

const Tiles kTiles{{7, {1.0f, 2.0f, 3.0f}}, {2, {4.0f}}, {9, {5.0f, 6.0f}}};

TEST_F(TileJournalTest, givesBackTilesWithoutValuesToo)
{
    const Tiles tiles{{1, {}},
                      {2, {4.0f}}}; // a memcpy of no bytes from null is undefined: seen by the sanitizer
    write(1, tiles);
    Tiles found;
    ASSERT_TRUE(read(1, found).ok());
    EXPECT_EQ(found, tiles);
}

TEST_F(TileJournalTest, givesBackWhatWasWritten)
{
    write(1, kTiles);
    Tiles tiles;
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_EQ(tiles, kTiles);
}

TEST_F(TileJournalTest, resumingWithoutAJournalBeginsOne)
{
    Tiles tiles;
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_TRUE(tiles.empty());
    EXPECT_TRUE(std::filesystem::exists(path_));
}

TEST_F(TileJournalTest, cutAnywhereItKeepsTheTilesThatAreWholeAndCanGoOn)
{
    write(1, kTiles);
    const uintmax_t size = std::filesystem::file_size(path_);
    std::ifstream file(path_, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    for (uintmax_t length = 0; length < size; ++length) {
        std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes.substr(0, length);
        {
            TileJournal journal(path_, 1);
            ASSERT_TRUE(journal.resume([](uint32_t, std::span<const float>) {}).ok()) << length;
            ASSERT_TRUE(journal.append(30, kTiles.at(7)).ok());
        }
        Tiles tiles;
        ASSERT_TRUE(read(1, tiles).ok());
        EXPECT_EQ(tiles.at(30), kTiles.at(7));
        EXPECT_LT(tiles.size(), 4u);
        for (const auto& [tile, values] : tiles)
            EXPECT_TRUE(tile == 30 || values == kTiles.at(tile));
    }
}

TEST_F(TileJournalTest, aDamagedTileAndAllBehindItAreDoneAgain)
{
    write(1, kTiles);
    std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-1, std::ios::end);
    file.put('x');
    file.close();
    Tiles tiles;
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_EQ(tiles.size(), 2u);
}

TEST_F(TileJournalTest, anotherPicturesJournalIsRefusedAndLeftAlone)
{
    write(1, kTiles);
    Tiles tiles;
    const base::Status status = read(2, tiles);
    EXPECT_EQ(status.code(), base::Code::InvalidArgument);
    EXPECT_NE(status.message().find(path_), std::string::npos);
    EXPECT_TRUE(tiles.empty());
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_EQ(tiles, kTiles);
}

TEST_F(TileJournalTest, twoRunsNeverWriteTheSameJournal)
{
    {
        TileJournal first(path_, 1);
        ASSERT_TRUE(first.start().ok());
        ASSERT_TRUE(first.append(7, kTiles.at(7)).ok());
        TileJournal second(path_, 1);
        const base::Status status = second.start();
        EXPECT_EQ(status.code(), base::Code::Io);
        EXPECT_NE(status.message().find(path_), std::string::npos);
        TileJournal third(path_, 2);
        EXPECT_EQ(third.resume([](uint32_t, std::span<const float>) {}).code(), base::Code::Io);
    }
    Tiles tiles;
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_EQ(tiles, (Tiles{{7, kTiles.at(7)}}));
}

TEST_F(TileJournalTest, aTileOfAnotherPictureBehindItsOwnIsNotTaken)
{
    write(2, kTiles);
    std::ifstream file(path_, std::ios::binary);
    const std::string other((std::istreambuf_iterator<char>(file)), {});
    write(1, {{30, {1.0f}}});
    std::ofstream(path_, std::ios::binary | std::ios::app) << other.substr(16); // without its header
    Tiles tiles;
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_EQ(tiles, (Tiles{{30, {1.0f}}}));
}

TEST_F(TileJournalTest, aFullDiskIsAnErrorThatNamesTheFileAndKeepsWholeTiles)
{
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{1000, before.rlim_max};
    base::Status status;
    {
        TileJournal journal(path_, 1);
        ASSERT_TRUE(journal.start().ok());
        ASSERT_TRUE(journal.append(1, std::vector<float>(100, 1.0f)).ok());
        setrlimit(RLIMIT_FSIZE, &small);
        status = journal.append(2, std::vector<float>(1000, 2.0f));
        EXPECT_FALSE(journal.append(3, std::vector<float>(1, 3.0f)).ok());
        setrlimit(RLIMIT_FSIZE, &before);
    }
    EXPECT_EQ(status.code(), base::Code::Io);
    EXPECT_NE(status.message().find(path_), std::string::npos);
    Tiles tiles;
    ASSERT_TRUE(read(1, tiles).ok());
    EXPECT_EQ(tiles.size(), 1u);
}

TEST_F(TileJournalTest, aRenderThatIsStoppedAndResumedGivesTheSamePictureBitForBit)
{
    const ReferenceScene scene = test::blobScene(40, 2.0);
    const test::Rendered expected(scene);
    const auto tasks = base::makeSerialRunner();
    uint32_t runs = 0;
    for (bool isDone = false; !isDone; ++runs) {
        ReferenceRenderer renderer;
        ASSERT_TRUE(renderer.build(scene, test::smallSettings(), *tasks).ok());
        TileJournal journal(path_, renderer.key());
        ASSERT_TRUE(
            journal.resume([&](uint32_t t, std::span<const float> v) { renderer.restore(t, v); }).ok());
        uint32_t asked = 0;
        const base::Status status = renderer.render(&journal, {{}, [&] { return asked++ == 40; }});
        isDone = status.ok();
        EXPECT_TRUE(isDone || status.code() == base::Code::Interrupted);
        for (uint32_t c = 0; isDone && c < reference_channel::Count; ++c)
            EXPECT_EQ(renderer.pixels(c), expected[c]);
        ASSERT_LT(runs, 50u);
    }
    EXPECT_GE(runs, 2u);
}

TEST_F(TileJournalTest, aStopInsideOfATileIsHeededAndTheTileIsNotKept)
{
    const auto tasks = base::makeSerialRunner();
    ReferenceRenderer renderer;
    ASSERT_TRUE(renderer.build(test::blobScene(40, 2.0), test::smallSettings(), *tasks).ok());
    uint32_t finished = 0;
    uint32_t asked = 0;
    const base::Status status =
        renderer.render(nullptr, {[&](uint32_t, uint32_t) { ++finished; }, [&] { return ++asked >= 3; }});
    EXPECT_EQ(status.code(), base::Code::Interrupted);
    EXPECT_EQ(finished, 0u);
    ASSERT_TRUE(renderer.render(nullptr, {[&](uint32_t done, uint32_t) { finished = done; }, {}}).ok());
    EXPECT_EQ(finished, renderer.tileCount());
}

} // namespace
} // namespace fx::render
