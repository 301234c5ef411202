#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/assets/volume_file.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/volume/volume_solver.h"
#include "tests/presets/temp_folder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace fx;

namespace {

/// Two bricks that touch at an edge, with extinctions that differ from voxel to voxel.
base::VoxelVolume twoBricks()
{
    base::VoxelVolume volume;
    volume.side = 0.5f;
    volume.origin = {1.0f, -2.0f, 3.0f};
    volume.bricks = {{1, 1, 1}, {2, 2, 1}};
    for (size_t v = 0; v < 2 * base::kVolumeBrickVoxels; ++v)
        volume.extinction.push_back(v % 3 == 0 ? 0.0f : float(v % 17) * 0.25f);
    return volume;
}

base::VoxelVolume colored()
{
    base::VoxelVolume volume = twoBricks();
    for (size_t v = 0; v < volume.extinction.size(); ++v) {
        volume.temperature.push_back(300.0f + float(v));
        volume.emission.push_back(volume.extinction[v] > 0.0f ? glm::vec3(float(v), 1.0f, 0.0f)
                                                              : glm::vec3(0.0f));
        volume.albedo.push_back(glm::vec3(0.25f, 0.5f, 0.75f));
        volume.emissionRate.push_back(float(v) - 500.0f);
    }
    return volume;
}

double massOf(const base::VoxelVolume& volume)
{
    double sum = 0.0;
    for (const float extinction : volume.extinction)
        sum += double(extinction);
    return sum * std::pow(double(volume.side), 3.0);
}

} // namespace

TEST(VolumeFile, isReadAsItWasWrittenUpToRounding)
{
    const base::VoxelVolume volume = colored();
    const auto bytes = asset::writeVolume(volume);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    const auto read = asset::parseVolume(*bytes);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->bricks, volume.bricks);
    EXPECT_EQ(read->side, volume.side);
    EXPECT_EQ(read->origin, volume.origin);
    for (size_t v = 0; v < volume.extinction.size(); ++v) {
        EXPECT_NEAR(read->extinction[v], volume.extinction[v], 0x1p-11f * volume.extinction[v]) << v;
        EXPECT_NEAR(read->temperature[v], volume.temperature[v], 0x1p-11f * volume.temperature[v]) << v;
        EXPECT_NEAR(read->emission[v].x, volume.emission[v].x, 0x1p-11f * volume.emission[v].x) << v;
        EXPECT_NEAR(read->albedo[v].y, 0.5f, 0x1p-12f) << v;
        EXPECT_NEAR(read->emissionRate[v], float(v) - 500.0f, 0x1p-2f) << v;
    }
    EXPECT_EQ(*asset::writeVolume(*read), *bytes);
}

TEST(VolumeFile, damagedFilesAreRefused)
{
    const std::string bytes = *asset::writeVolume(colored());
    for (size_t size = 0; size < bytes.size(); size += size < 300 ? 1 : 61)
        EXPECT_FALSE(asset::parseVolume(std::string_view(bytes).substr(0, size)).ok()) << size;
    EXPECT_FALSE(asset::parseVolume(bytes + "x").ok());
    for (size_t at = 0; at < bytes.size(); at += 7) {
        std::string damaged = bytes;
        damaged[at] = char(damaged[at] ^ 0x15);
        EXPECT_FALSE(asset::parseVolume(damaged).ok()) << at;
    }
    EXPECT_EQ(asset::parseVolume("fxvolume 2\n").status().code(), base::Code::Version);
    EXPECT_EQ(asset::parseVolume("fxvolume 1\nbricks 32769\n").status().code(), base::Code::TooLarge);
}

TEST(VolumeFile, whatCannotBeReadIsNotWritten)
{
    base::VoxelVolume volume = twoBricks();
    volume.extinction[4] = -1.0f;
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume.extinction[4] = NAN;
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume = twoBricks();
    volume.bricks[1].x = base::kMaxVolumeBricksPerAxis;
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume.bricks = {{2, 2, 1}, {1, 1, 1}};
    EXPECT_FALSE(asset::writeVolume(volume).ok()) << "not in ascending order";
    volume.bricks = {{1, 1, 1}, {1, 1, 1}};
    EXPECT_FALSE(asset::writeVolume(volume).ok()) << "twice the same";
    volume = twoBricks();
    volume.evenAlbedo.y = 1.5f;
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume = twoBricks();
    volume.albedo.resize(7);
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume = colored();
    volume.emissionRate[3] = -2.0f * base::kMostVolumeRate;
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume.emissionRate.resize(7);
    EXPECT_FALSE(asset::writeVolume(volume).ok());
    volume.bricks.clear();
    volume.extinction.clear();
    EXPECT_FALSE(asset::writeVolume(volume).ok());
}

TEST(VolumeFile, aMediumThatOnlyAbsorbsStaysBlack)
{
    base::VoxelVolume volume = twoBricks();
    volume.albedo.assign(volume.extinction.size(), glm::vec3(0.0f));
    const auto read = asset::parseVolume(*asset::writeVolume(volume));
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->albedo.empty() ? read->evenAlbedo : read->albedo[5], glm::vec3(0.0f));
}

TEST(VolumeFile, lightOfVoxelsWithoutMediumIsNotWrittenAndIsRefused)
{
    base::VoxelVolume volume = colored();
    volume.emission[0] = glm::vec3(1000.0f); // voxel 0 has no extinction
    const auto bytes = asset::writeVolume(volume);
    const auto read = asset::parseVolume(*bytes);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->emission[0], glm::vec3(0.0f));
    std::string glowing = *bytes; // the first value of the emission
    const size_t hash = glowing.find("\nhash "), data = glowing.find("\ndata\n") + 6;
    glowing[data + 2 * (6 + 1024 + 1024)] = 1;
    const std::string_view text = glowing;
    char digits[20];
    std::snprintf(
        digits, sizeof digits, "%llx",
        static_cast<unsigned long long>(asset::volumeHash(text.substr(0, hash + 1), text.substr(data))));
    const std::string sealed = glowing.substr(0, hash + 6) + digits + "\ndata\n" + glowing.substr(data);
    const base::Status refused = asset::parseVolume(sealed).status();
    EXPECT_NE(refused.message().find("emission: voxel 0"), std::string::npos) << refused.message();
}

TEST(VolumeFile, thatADocumentNamesTwiceIsReadOnce)
{
    struct Storage
    {
        std::string bytes;
        int reads = 0;
    } storage{*asset::writeVolume(twoBricks())};
    const asset::ReadHook hook{&storage, [](void* user, const char* name, uint64_t,
                                            void (*deliver)(void*, const void*, size_t), void* sink) {
                                   auto& own = *static_cast<Storage*>(user);
                                   if (std::string_view(name) != "a.fxvolume")
                                       return 1;
                                   ++own.reads;
                                   deliver(sink, own.bytes.data(), own.bytes.size());
                                   return 0;
                               }};
    const asset::AssetResolver resolver("", {}, hook);
    base::AssetTable table(std::pmr::get_default_resource());
    asset::AssetLoader loader(resolver, table, asset::MissingAsset::IsAnError);
    const auto first = loader.volume("a.fxvolume");
    ASSERT_TRUE(first.ok()) << first.status().message();
    const uint64_t hash = loader.contentHash();
    const auto second = loader.volume("a.fxvolume");
    ASSERT_TRUE(second.ok());
    EXPECT_EQ(*second, *first);
    EXPECT_EQ(storage.reads, 1);
    EXPECT_EQ(loader.contentHash(), hash);
    EXPECT_FALSE(loader.volume("b.fxvolume").ok());
    EXPECT_FALSE(loader.volume("b.fxvolume").ok()) << "an error stays one";
}

TEST(VolumeCells, haveTheMediumOfAllVoxelsAndReachTheBricksBefore)
{
    base::VoxelVolume volume;
    volume.side = 0.5f;
    volume.bricks = {{2, 2, 2}};
    volume.extinction.assign(base::kVolumeBrickVoxels, 0.0f);
    volume.extinction[0] = 8.0f; // on the corner of eight bricks
    volume.extinction[3 + 8 * 3 + 64 * 3] = 1.0f;
    const std::vector<base::VolumeCells> cells = base::volumeCells(volume);
    ASSERT_EQ(cells.size(), 8u);
    for (size_t i = 0; i < 7; ++i)
        EXPECT_FLOAT_EQ(cells[i].crossSection, 0.125f) << i; // an eighth of 8 times the volume of a voxel
    EXPECT_EQ(cells[7].brick, glm::ivec3(2));
    EXPECT_FLOAT_EQ(cells[7].crossSection, 0.25f);
    base::VoxelVolume even = colored();
    even.temperature.assign(even.extinction.size(), 700.0f);
    for (size_t v = 0; v < even.emission.size(); ++v)
        even.emission[v] = even.extinction[v] * glm::vec3(2.0f, 0.0f, 5.0f);
    for (const base::VolumeCells& brick : base::volumeCells(even)) {
        EXPECT_FLOAT_EQ(brick.temperature, 700.0f);
        EXPECT_LT(glm::length(brick.albedo - glm::vec3(0.25f, 0.5f, 0.75f)), 1e-6f);
        EXPECT_LT(glm::length(brick.emission - glm::vec3(2.0f, 0.0f, 5.0f)), 1e-5f);
    }
    double sum = 0.0;
    for (const base::VolumeCells& brick : base::volumeCells(twoBricks()))
        sum += double(brick.crossSection);
    EXPECT_NEAR(sum, massOf(twoBricks()), 1e-5 * sum);
}

TEST(VolumeCells, ofTwoFarBricksAreFoundAtOnce)
{
    base::VoxelVolume volume;
    volume.bricks = {{1, 1, 1}, {127, 127, 127}};
    volume.extinction.assign(2 * base::kVolumeBrickVoxels, 1.0f);
    for (int i = 0; i < 200; ++i) // minutes if all places between them were visited
        ASSERT_EQ(base::volumeCells(volume).size(), 16u);
}

TEST(Volume, publishesABallAroundEachBrickAndThePlaceOfTheVoxels)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    schema.add(base::kVolumeKind);
    sim::VolumeDef def;
    def.voxels = std::make_shared<base::VoxelVolume>(twoBricks());
    def.cells = base::volumeCells(*def.voxels);
    def.asset = 7;
    def.position = {10, 20, 30};
    def.scale = 2.0f;
    def.density = 3.0f;
    const auto solver = def.create(schema, {}, std::pmr::get_default_resource());
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    solver->publish({}, snapshot);
    ASSERT_EQ(snapshot.groupCount(), 2u);
    const base::SnapshotGroup& blobs = snapshot.group(0);
    ASSERT_EQ(blobs.count(), def.cells.size());
    namespace blob = base::blob_column;
    double sum = 0.0;
    for (size_t i = 0; i < blobs.count(); ++i) {
        sum += double(blobs.column(blob::CrossSection)[i]);
        const glm::vec3 center(blobs.column(blob::PositionX)[i], blobs.column(blob::PositionY)[i],
                               blobs.column(blob::PositionZ)[i]);
        const glm::vec3 corner = // of the brick, farthest from the center
            def.position + 2.0f * (def.voxels->origin + 4.0f * glm::vec3(def.cells[i].brick));
        EXPECT_LT(glm::length(corner - center), blobs.column(blob::Radius)[i]) << i;
    }
    EXPECT_NEAR(sum, 3.0 * 4.0 * massOf(*def.voxels), 1e-5 * sum); // optical depths keep their values
    const auto constants = snapshot.group(1).constants();
    namespace c = base::volume_constant;
    EXPECT_EQ(snapshot.group(1).count(), 0u);
    EXPECT_EQ(constants[c::Asset], 7.0f);
    EXPECT_EQ(constants[c::Side], 1.0f);
    EXPECT_EQ(constants[c::OriginY], 16.0f);
    EXPECT_EQ(constants[c::Density], 1.5f);
}

TEST(Volume, coordinatesOfItsDetailArePlacesInIt)
{
    base::SnapshotSchema schema;
    for (const base::KindDesc* kind : {&base::kBlobKind, &base::kMaterialKind, &base::kVolumeKind})
        schema.add(*kind);
    sim::VolumeDef def;
    def.voxels = std::make_shared<base::VoxelVolume>(twoBricks());
    def.cells = base::volumeCells(*def.voxels);
    def.scale = 2.0f;
    def.detail = {.given = true, .billowSize = 3.0f};
    const auto solver = def.create(schema, {}, std::pmr::get_default_resource());
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    solver->publish({}, snapshot);
    ASSERT_EQ(snapshot.groupCount(), 3u);
    const base::SnapshotGroup& blobs = snapshot.group(0);
    const base::SnapshotGroup& material = snapshot.group(1);
    ASSERT_EQ(material.count(), blobs.count());
    namespace m = base::material_column;
    for (size_t i = 0; i < blobs.count(); ++i) {
        EXPECT_EQ(material.ids()[i], blobs.ids()[i]);
        for (size_t k = 0; k < 3; ++k) {
            const float place = blobs.column(base::blob_column::PositionX + k)[i];
            EXPECT_EQ(material.column(m::Place0X + k)[i], place);
            EXPECT_EQ(material.column(m::Place1X + k)[i], place);
        }
    }
    namespace c = base::material_constant;
    EXPECT_EQ(material.constants()[c::Fade], 0.0f);
    EXPECT_FLOAT_EQ(material.constants()[c::Length0], 1.1f * 3.0f * 8.0f * 2.0f * twoBricks().side);
    EXPECT_EQ(material.constants()[c::Lossy], 1.0f);
    EXPECT_GT(def.bytes(), 0u);
    def.detail.given = false;
    EXPECT_EQ(def.bytes(), 0u);
}

TEST(Volumes, presetsStateTheirDetail)
{
    const test::TempFolder folder;
    folder.write("a.fxvolume", *asset::writeVolume(twoBricks()));
    const auto load = [&](const std::string& detail) {
        return preset::loadPresetFile(folder.write(
            "p.fx.json", R"({"version": 1, "volumes": [{"file": "a.fxvolume", "detail": )" + detail + "}]}"));
    };
    const auto loaded = load(R"({"material": "dust", "crispness": 0.9})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const auto* def = dynamic_cast<const sim::VolumeDef*>(loaded->effect->solvers[0].get());
    ASSERT_NE(def, nullptr);
    EXPECT_TRUE(def->detail.given);
    EXPECT_EQ(def->detail.material, sim::DetailMaterial::Dust);
    EXPECT_EQ(def->detail.crispness, 0.9f);
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(load(R"({"material": "smoke", "liveliness": 2})")->warnings.size(), 1u);
    const auto wrong = load(R"({"material": "smoke", "crispness": 2})");
    ASSERT_FALSE(wrong.ok());
    EXPECT_NE(wrong.status().message().find("crispness"), std::string::npos) << wrong.status().message();
    EXPECT_FALSE(load(R"({"crispness": 0.5})").ok()) << "the material is needed";
}

TEST(Volumes, presetsNameTheirFileAndWithoutOneAreErrors)
{
    const auto missing = preset::loadPresetText(R"({"version": 1, "volumes": [{}]})", "t");
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.status().message().find("fxvolume"), std::string::npos) << missing.status().message();
    const test::TempFolder folder;
    const std::string text = R"({"version": 1, "volumes": [{"file": "a.fxvolume", "density": 2}]})";
    folder.write("a.fxvolume", *asset::writeVolume(twoBricks()));
    const auto loaded = preset::loadPresetFile(folder.write("p.fx.json", text));
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const auto* def = dynamic_cast<const sim::VolumeDef*>(loaded->effect->solvers[0].get());
    ASSERT_NE(def, nullptr);
    EXPECT_EQ(def->density, 2.0f);
    EXPECT_NE(def->asset, 0u);
    EXPECT_EQ(def->voxels->bricks.size(), 2u);
    EXPECT_EQ(loaded->effect->hints.composition, sim::PreferredComposition::Volume);
    const auto sorted = preset::loadPresetFile(folder.write(
        "q.fx.json", R"({"version": 1, "composition": "sorted", "volumes": [{"file": "a.fxvolume"}]})"));
    ASSERT_TRUE(sorted.ok()) << sorted.status().message();
    EXPECT_EQ(sorted->effect->hints.composition, sim::PreferredComposition::Sorted);
}
