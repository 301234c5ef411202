// Fields of distances beside their meshes: the same field, whatever lies there.
#include "fxsdk/cli/scene/effect_scene.h"
#include "fxsdk/cli/scene/field_cache.h"
#include "tests/simulation/collision/shapes.h"
#include "tests/tool/temporary_folder.h"

#include <bit>
#include <cstring>
#include <functional>
#include <sys/stat.h>

namespace fx::cli {
namespace {

namespace fs = std::filesystem;

constexpr float kCell = 0.1f;
constexpr size_t kHeader = 40; ///< [byte]
constexpr size_t kFieldHashAt = 32;

std::shared_ptr<const sim::DistanceField> fieldFrom(const test::Soup& soup, const fs::path& file,
                                                    float cell = kCell)
{
    const auto tasks = base::makeSerialRunner();
    auto field = fieldOf(test::viewOf(soup), cell, file, *tasks, std::pmr::get_default_resource());
    EXPECT_TRUE(field.ok()) << field.status().message();
    return field.ok() ? *field : nullptr;
}

const test::Soup& ball()
{
    static const test::Soup soup = test::sphereMesh(0.6f, 8);
    return soup;
}

uint64_t ballHash()
{
    static const uint64_t hash = fieldFrom(ball(), {})->hash();
    return hash;
}

std::string bytesOf(const fs::path& file)
{
    return test::readText(file);
}

/// The file of another field of the ball that is whole in itself: each value is lower by a millimeter.
std::string shiftedFile(const std::string& file, const sim::DistanceField& field)
{
    std::vector<float> values(field.values().begin(), field.values().end());
    for (float& value : values)
        value -= 1e-3f;
    const uint64_t hash =
        sim::DistanceField::restore(field.origin(), field.grid(), values, std::pmr::get_default_resource())
            ->hash();
    std::string shifted = file;
    std::memcpy(shifted.data() + kFieldHashAt, &hash, sizeof hash);
    std::memcpy(shifted.data() + kHeader, values.data(), values.size() * sizeof(float));
    return shifted;
}

TEST(FieldCache, whatWasMadeOnceIsReadFromThenOn)
{
    const test::TemporaryFolder folder;
    const fs::path file = folder / "ball.fxfield";
    const auto made = fieldFrom(ball(), file);
    EXPECT_EQ(made->hash(), ballHash());
    ASSERT_EQ(folder.entries(), 1u);
    EXPECT_EQ(fs::file_size(file), kHeader + 4 * made->grid().count());
    EXPECT_EQ(fieldFrom(ball(), file)->hash(), ballHash());

    test::writeText(file, shiftedFile(bytesOf(file), *made)); // only a reader gets this one
    const auto read = fieldFrom(ball(), file);
    EXPECT_FLOAT_EQ(read->values()[5], made->values()[5] - 1e-3f);
}

TEST(FieldCache, damagedForeignAndOldFilesAreIgnoredAndReplaced)
{
    const test::TemporaryFolder folder;
    const fs::path file = folder / "ball.fxfield";
    static_cast<void>(fieldFrom(ball(), file));
    const std::string good = bytesOf(file);
    const auto with = [&good](size_t at, char bits) {
        std::string bytes = good;
        bytes[at] = char(bytes[at] ^ bits);
        return bytes;
    };
    std::string notANumber = good;
    std::memset(notANumber.data() + kHeader + 40, 0xFF, 4);
    const std::string bad[] = {"",
                               "nothing of the kind",
                               good.substr(0, good.size() - 1),
                               good.substr(0, kHeader - 1),
                               good + "x",
                               with(0, 1),            // magic
                               with(8, 1),            // version
                               with(12, 1),           // nodes
                               with(24, 1),           // hash of the mesh
                               with(kFieldHashAt, 1), // hash of the field
                               with(kHeader + 400, 1),
                               notANumber};
    for (const std::string& bytes : bad) {
        test::writeText(file, bytes);
        EXPECT_EQ(fieldFrom(ball(), file)->hash(), ballHash());
        EXPECT_TRUE(bytesOf(file) == good);
    }
    EXPECT_EQ(folder.entries(), 1u); // no temporary file remains
}

TEST(FieldCache, anotherMeshOrAnotherSizeOfCellsIsMadeAnew)
{
    const test::TemporaryFolder folder;
    const fs::path file = folder / "ball.fxfield";
    static_cast<void>(fieldFrom(ball(), file));
    test::Soup moved = ball();
    moved[7].x = std::bit_cast<float>(std::bit_cast<uint32_t>(moved[7].x) + 1);
    EXPECT_EQ(fieldFrom(moved, file)->hash(), fieldFrom(moved, {})->hash());
    EXPECT_EQ(fieldFrom(ball(), file, 0.13f)->hash(), fieldFrom(ball(), {}, 0.13f)->hash());
    EXPECT_NE(fieldFileOf("a.obj", test::viewOf(ball()), 0.1f),
              fieldFileOf("a.obj", test::viewOf(ball()), 0.2f));
    EXPECT_EQ(fieldFileOf("x/a.obj", test::viewOf(ball()), 0.1f).parent_path(), "x");
}

TEST(FieldCache, whereNothingCanBeWrittenTheFieldIsMadeAllTheSame)
{
    const test::TemporaryFolder folder;
    EXPECT_EQ(fieldFrom(ball(), folder / "no/such/folder/ball.fxfield")->hash(), ballHash());
    fs::create_directory(folder / "folder");
    EXPECT_EQ(fieldFrom(ball(), folder / "folder")->hash(), ballHash());
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0); // opening it would wait for ever
    EXPECT_EQ(fieldFrom(ball(), folder / "pipe")->hash(), ballHash());
    test::writeText(folder / "other", "of somebody else");
    fs::create_symlink(folder / "other", folder / "link");
    EXPECT_EQ(fieldFrom(ball(), folder / "link")->hash(), ballHash());
    EXPECT_EQ(bytesOf(folder / "other"), "of somebody else");
    EXPECT_EQ(folder.entries(), 4u);
}

TEST(FieldCache, aMeshThatCannotBeCollidedWithFailsAsWithoutAFile)
{
    const test::TemporaryFolder folder;
    const auto tasks = base::makeSerialRunner();
    const test::Soup flat{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    for (const fs::path& file : {fs::path(), folder / "flat.fxfield"}) {
        const auto field = fieldOf(test::viewOf(flat), kCell, file, *tasks, std::pmr::get_default_resource());
        EXPECT_EQ(field.status().code(), base::Code::InvalidArgument);
    }
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(FieldCache, aSceneStartsFromItAndDoesTheSame)
{
    const test::TemporaryFolder folder;
    test::writeText(folder / "wall.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0.3 1\nv -1 0.3 1\nf 4 3 2 1\n");
    test::writeText(folder / "a.scene.json",
                    R"({"version": 1, "camera": {"position": [0, 1, 8], "target": [0, 1, 0]},
                        "mesh": {"file": "wall.obj", "collide": true, "cellSize": 0.05},
                        "instances": [{"preset": "library:debris", "position": [0, 1, 0]}]})");
    uint64_t hashes[2] = {};
    for (uint64_t& hash : hashes) {
        const auto file = scene_file::loadSceneFile((folder / "a.scene.json").string());
        ASSERT_TRUE(file.ok()) << file.status().message();
        const auto effects = EffectScene::create(*file, {});
        ASSERT_TRUE(effects.ok()) << effects.status().message();
        EXPECT_EQ(folder.entries(), 3u);
        ASSERT_TRUE((*effects)->showMoment(base::toTicks(0.5)).ok());
        ASSERT_EQ(fxScene_GetSimulationHash((*effects)->scene(), &hash), FX_OK);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

} // namespace
} // namespace fx::cli
