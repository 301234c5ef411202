// Sequences of volumes: files, presets, and what is published at a time.
#include "foundation/snapshot/volume_kind.h"
#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/assets/frame_name.h"
#include "fxsdk/assets/volume_file.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/state/state_reader.h"
#include "simulation/state/state_writer.h"
#include "simulation/volume/sequence_solver.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace fx;

namespace {

constexpr uint32_t kFrames = 5;
constexpr float kSide = 0.5f;
constexpr base::Ticks kStep = base::kTicksPerSecond / 60;

/// One full brick, which is one brick farther along x in each frame, and doubles its extinction.
base::VoxelVolume frameOf(uint32_t frame, bool hasVelocities = true)
{
    base::VoxelVolume volume;
    volume.side = kSide;
    volume.bricks = {{1, 1, 1}};
    volume.origin = glm::vec3(8.0f * kSide * float(frame), 1.0f, -2.0f);
    volume.extinction.assign(base::kVolumeBrickVoxels, std::ldexp(1.0f, int(frame)));
    if (hasVelocities)
        volume.velocity.assign(base::kVolumeBrickVoxels, glm::vec3(-8.0f, 2.0f, 0.25f));
    return volume;
}

class Folder : public test::TempFolder
{
public:
    explicit Folder(bool hasVelocities = true)
    {
        for (uint32_t i = 0; i < kFrames; ++i)
            writeFrame(i, frameOf(i, hasVelocities));
    }
    void writeFrame(uint32_t i, const base::VoxelVolume& volume) const
    {
        write("a." + std::to_string(10 + i) + ".fxvolume", *asset::writeVolume(volume));
    }
    base::Result<preset::LoadedPreset> load(const std::string& members,
                                            std::vector<preset::Diagnostic>* outDiagnostics = nullptr) const
    {
        return preset::loadPresetFile(
            write("p.fx.json", R"({"version": 1, "volumes": [{"file": "a.%d.fxvolume", "frames": 5, )"
                               R"("firstFrame": 10, "framesPerSecond": 20)" +
                                   members + "}]}"),
            outDiagnostics);
    }
};

const sim::SequenceDef& defOf(const preset::LoadedPreset& preset)
{
    return dynamic_cast<const sim::SequenceDef&>(*preset.effect->solvers[0]);
}

/// A solver of a preset, stepped at 60 steps a second.
class Player
{
public:
    explicit Player(const preset::LoadedPreset& preset)
    {
        schema_.add(base::kBlobKind);
        schema_.add(base::kVolumeKind);
        solver_ = defOf(preset).create(schema_, {}, std::pmr::get_default_resource());
    }
    void stepTo(base::Ticks tick)
    {
        for (; now_ < tick; now_ += kStep) {
            sim::StepContext context{};
            context.tick = now_;
            context.stepTicks = kStep;
            solver_->step(context);
        }
    }
    void seek(base::Ticks tick)
    {
        solver_->seekable()->seek({}, tick);
        now_ = tick;
    }
    sim::Solver& solver() { return *solver_; }
    /// @param step [tick] local time of an instance in the last step
    base::FrameSnapshot publish(base::Ticks step = kStep) const
    {
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(now_, 1, kStep);
        base::GroupInfo info;
        info.step = step;
        solver_->publish(info, snapshot);
        return snapshot;
    }
    float constant(size_t which) const { return publish().group(1).constants()[which]; }
    double crossSection() const
    {
        const base::FrameSnapshot snapshot = publish();
        double sum = 0.0;
        for (uint32_t i = 0; i < snapshot.group(0).count(); ++i)
            sum += double(snapshot.group(0).column(base::blob_column::CrossSection)[i]);
        return sum;
    }

private:
    base::SnapshotSchema schema_;
    std::unique_ptr<sim::Solver> solver_;
    base::Ticks now_ = 0;
};

constexpr double kBrick = 512.0 * double(kSide) * double(kSide) * double(kSide); // cross section of frame 0

std::string refusal(const base::Result<preset::LoadedPreset>& loaded)
{
    return loaded.ok() ? "loaded" : loaded.status().message();
}

} // namespace

TEST(FrameName, hasOnePlaceholder)
{
    EXPECT_EQ(*asset::frameName("a.%04d.fxvolume", 7), "a.0007.fxvolume");
    EXPECT_EQ(*asset::frameName("b/%d.fxvolume", 12345), "b/12345.fxvolume");
    EXPECT_EQ(*asset::frameName("%3d", 4), "004");
    for (const char* wrong : {"a.fxvolume", "a%", "a%s", "a%04x", "%d%d", "%%d", "%0123d", "%-4d"})
        EXPECT_FALSE(asset::frameName(wrong, 1).ok()) << wrong;
}

TEST(VolumeFile, velocitiesHaveASign)
{
    base::VoxelVolume volume = frameOf(0);
    const auto read = asset::parseVolume(*asset::writeVolume(volume));
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->velocity[0], glm::vec3(-8.0f, 2.0f, 0.25f));
    volume.velocity.assign(volume.velocity.size(), glm::vec3(0.0f));
    EXPECT_EQ(asset::parseVolume(*asset::writeVolume(volume))->velocity.size(), volume.velocity.size())
        << "at rest is not unknown";
}

TEST(VolumeSequences, framesLieOnOneLatticeWhereverTheirOriginIs)
{
    const Folder folder;
    const auto loaded = folder.load("");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    base::VolumeSequence& sequence = *defOf(*loaded).sequence;
    ASSERT_EQ(sequence.count(), kFrames);
    EXPECT_TRUE(sequence.hasOneLattice());
    EXPECT_EQ(glm::vec3(sequence.lattice(3).origin), frameOf(0).origin);
    EXPECT_TRUE(sequence.hasVelocities());
    for (uint32_t i = 0; i < kFrames; ++i) {
        const auto frame = sequence.wait(i);
        ASSERT_TRUE(frame.ok());
        EXPECT_EQ((*frame)->bricks[0], glm::ivec3(1 + int(i), 1, 1));
        EXPECT_EQ(sequence.cells(i).back().brick, (*frame)->bricks[0]);
    }
}

/// The frames with voxels that become larger, each on its own lattice; cross sections as in frameOf().
base::VoxelVolume growingFrameOf(uint32_t frame)
{
    base::VoxelVolume volume = frameOf(frame);
    const float larger = 1.0f + 0.1f * float(frame);
    volume.side = kSide * larger;
    volume.origin.z -= 0.3f * float(frame);
    for (float& extinction : volume.extinction)
        extinction /= larger * larger * larger;
    return volume;
}

class GrowingFolder : public Folder
{
public:
    GrowingFolder()
    {
        for (uint32_t i = 0; i < kFrames; ++i)
            writeFrame(i, growingFrameOf(i));
    }
};

TEST(VolumeSequences, framesWithVoxelsOfOtherSidesHaveTheirOwnLattices)
{
    const GrowingFolder folder;
    const auto loaded = folder.load("");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    base::VolumeSequence& sequence = *defOf(*loaded).sequence;
    EXPECT_FALSE(sequence.hasOneLattice());
    for (uint32_t i = 0; i < kFrames; ++i) {
        const auto frame = sequence.wait(i);
        ASSERT_TRUE(frame.ok());
        const base::VoxelVolume wanted = growingFrameOf(i);
        const base::VolumeLattice lattice = sequence.lattice(i);
        EXPECT_EQ(float(lattice.side), wanted.side);
        for (int a = 0; a < 3; ++a)
            EXPECT_NEAR(lattice.origin[a] + 8.0 * lattice.side * (*frame)->bricks[0][a],
                        double(wanted.origin[a] + 8.0f * wanted.side), 1e-4);
    }
}

TEST(VolumeSequences, onTheirOwnLatticesKeepTheirMassAndAreSoughtAsTheyArePlayed)
{
    const GrowingFolder folder;
    const auto loaded = folder.load(R"(, "end": "loop")");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    Player player(*loaded);
    namespace c = base::volume_constant;
    EXPECT_NEAR(player.crossSection(), kBrick, 1e-4 * kBrick);
    for (int step = 1; step < 40; ++step) {
        player.stepTo(step * kStep);
        const double frame = std::fmod(step / 3.0, 5.0);
        const int first = int(frame + 1e-6), next = (first + 1) % 5;
        const double part = std::max(frame - first, 0.0);
        const double wanted = ((1.0 - part) * std::ldexp(1.0, first) + part * std::ldexp(1.0, next)) * kBrick;
        EXPECT_NEAR(player.crossSection() / wanted, 1.0, 1e-4) << step;
        const base::FrameSnapshot played = player.publish();
        const auto lattice = uint32_t(played.group(1).constants()[c::Lattice]);
        EXPECT_EQ(lattice, uint32_t(part < 1e-6 || first < next ? first : next)) << step;
        EXPECT_EQ(played.group(1).constants()[c::Side], growingFrameOf(lattice).side);
        Player sought(*loaded);
        sought.seek(step * kStep);
        const base::FrameSnapshot there = sought.publish();
        EXPECT_TRUE(std::ranges::equal(there.group(0).ids(), played.group(0).ids()));
        EXPECT_TRUE(std::ranges::equal(there.group(1).constants(), played.group(1).constants()));
        for (const size_t column : {base::blob_column::CrossSection, base::blob_column::PositionX})
            EXPECT_TRUE(std::ranges::equal(there.group(0).column(column), played.group(0).column(column)));
    }
}

TEST(VolumeSequences, aBrickOfAnotherLatticeIsAnotherBall)
{
    const GrowingFolder folder;
    const auto loaded = folder.load("");
    Player player(*loaded);
    player.stepTo(3 * kStep); // frame 1
    const base::FrameSnapshot older = player.publish();
    player.stepTo(6 * kStep); // frame 2
    const base::FrameSnapshot newer = player.publish();
    for (const uint64_t id : newer.group(0).ids())
        EXPECT_EQ(std::ranges::count(older.group(0).ids(), id), 0) << id;
    for (const float age : newer.group(0).column(base::blob_column::Age))
        EXPECT_GT(age, float(base::toSeconds(kStep))) << "it is shown before the step ends";
}

TEST(VolumeSequences, areInterpolatedInTime)
{
    const Folder folder;
    const auto loaded = folder.load("");
    Player player(*loaded);
    namespace c = base::volume_constant;
    EXPECT_NEAR(player.crossSection(), kBrick, 1e-4 * kBrick);
    player.stepTo(base::kTicksPerSecond / 12); // frame 5/3
    EXPECT_NEAR(player.constant(c::Frame), 5.0f / 3.0f, 1e-5f);
    EXPECT_NEAR(player.constant(c::FrameBefore), 4.0f / 3.0f, 1e-5f);
    for (const int speed : {0, 2}) // of an instance that rests, and of one that is played fast
        EXPECT_NEAR(player.publish(speed * kStep).group(1).constants()[c::FrameBefore],
                    player.constant(c::Frame) - float(speed) * (player.constant(c::Frame) - 4.0f / 3.0f),
                    1e-5f);
    EXPECT_NEAR(player.constant(c::FrameSeconds), 0.05f, 1e-7f);
    EXPECT_NEAR(player.crossSection(), (2.0 / 3.0 + 8.0 / 3.0) * kBrick, 1e-4 * kBrick);
}

TEST(VolumeSequences, aStepShowsTheBricksOfAllItsFrames)
{
    const Folder folder;
    const auto loaded = folder.load("");
    Player player(*loaded);
    player.stepTo(4 * kStep);                          // from frame 1 to 4/3: frames 1 and 2
    EXPECT_EQ(player.publish().group(0).count(), 12u); // 8 around each brick, of which 4 are the same
    player.stepTo(7 * kStep);                          // from frame 2 to 7/3
    const base::FrameSnapshot snapshot = player.publish();
    EXPECT_EQ(snapshot.group(0).count(), 12u);
    std::set<uint64_t> ids(snapshot.group(0).ids().begin(), snapshot.group(0).ids().end());
    EXPECT_EQ(ids.size(), 12u);
    for (uint32_t i = 0; i < 12; ++i)
        EXPECT_GT(snapshot.group(0).column(base::blob_column::CrossSection)[i], 0.0f);
}

TEST(VolumeSequences, holdTheLastFrameOrBeginAgain)
{
    const Folder folder;
    const auto held = folder.load(""), looped = folder.load(R"(, "end": "loop")");
    Player holds(*held), loops(*looped);
    namespace c = base::volume_constant;
    for (Player* player : {&holds, &loops})
        player->stepTo(14 * kStep); // frame 14/3 of 5
    EXPECT_EQ(holds.constant(c::Frame), 4.0f);
    EXPECT_NEAR(loops.constant(c::Frame), 14.0f / 3.0f, 1e-5f);
    EXPECT_NEAR(loops.crossSection(), (16.0 / 3.0 + 2.0 / 3.0) * kBrick, 1e-4 * kBrick);
    loops.stepTo(16 * kStep); // frame 1/3 again, from 0
    EXPECT_NEAR(loops.constant(c::Frame), 1.0f / 3.0f, 1e-5f);
    loops.stepTo(31 * kStep); // from 0 again: exactly at the beginning of the third time
    holds.stepTo(100 * kStep);
    EXPECT_EQ(holds.constant(c::Frame), 4.0f);
    EXPECT_EQ(holds.constant(c::FrameBefore), 4.0f);
    sim::SeekableSolver& seekable = *holds.solver().seekable();
    EXPECT_GT(seekable.restsUntil(base::toTicks(5.0)), base::toTicks(100.0));
    EXPECT_EQ(seekable.restsUntil(base::toTicks(0.1)), base::toTicks(0.1));
}

TEST(VolumeSequences, aStepIsLinearInTimeAlsoWhereItBeginsBeforeTheStartOrEndsAfterTheEnd)
{
    using sim::SequenceTime;
    const SequenceTime held{4, 24.0f, sim::SequenceEnd::Hold}, looped{4, 24.0f, sim::SequenceEnd::Loop};
    for (const SequenceTime& time : {held, looped}) {
        const SequenceTime::Way first = time.wayTo(kStep / 2, kStep); // starts in the middle of a step
        EXPECT_NEAR(first.before, -0.2, 1e-9);
        EXPECT_NEAR(first.frame, 0.2, 1e-9);
    }
    const SequenceTime::Way end = held.wayTo(8 * kStep, kStep); // the last frame is at 7.5 steps
    EXPECT_NEAR(end.before, 2.8, 1e-9);
    EXPECT_NEAR(end.frame, 3.2, 1e-9);
    EXPECT_EQ(held.wayTo(9 * kStep, kStep).before, 3.0);
    EXPECT_EQ(held.wayTo(9 * kStep, kStep).frame, 3.0);
    const SequenceTime::Way seam = looped.wayTo(21 * kStep, kStep); // begins again at 20 steps
    EXPECT_NEAR(seam.frame - seam.before, 0.4, 1e-9);
    EXPECT_NEAR(std::fmod(seam.frame, 4.0), 0.4, 1e-9);
}

TEST(VolumeSequences, aLoopBeginsAgainAboveTheNumberOfFrames)
{
    const Folder folder;
    const auto loaded = folder.load(R"(, "end": "loop", "framesPerSecond": 24)");
    ASSERT_FALSE(loaded.ok()) << "a member may not be given twice";
    const auto looped = folder.load(R"(, "end": "loop", "scale": 2)");
    Player player(*looped);
    player.stepTo(15 * kStep); // frame 5 is frame 0
    namespace c = base::volume_constant;
    EXPECT_NEAR(player.constant(c::Frame), 5.0f, 1e-5f);
    EXPECT_NEAR(player.constant(c::FrameBefore), 14.0f / 3.0f, 1e-5f);
    EXPECT_EQ(player.constant(c::Loops), 1.0f);
}

TEST(VolumeSequences, seekingAndRestoringIsAsPlaying)
{
    const Folder folder;
    const auto loaded = folder.load("");
    Player played(*loaded), sought(*loaded), restored(*loaded);
    played.stepTo(11 * kStep);
    sought.solver().seekable()->seek({}, 11 * kStep);
    sim::StateBuffer states[2] = {sim::StateBuffer(std::pmr::get_default_resource()),
                                  sim::StateBuffer(std::pmr::get_default_resource())};
    played.solver().save(states[0]);
    sought.solver().save(states[1]);
    EXPECT_TRUE(std::ranges::equal(states[0].bytes(), states[1].bytes()));
    sim::StateReader reader(states[0].bytes());
    restored.solver().restore(reader);
    for (Player* player : {&sought, &restored}) {
        EXPECT_EQ(player->crossSection(), played.crossSection());
        EXPECT_EQ(player->constant(base::volume_constant::Frame),
                  played.constant(base::volume_constant::Frame));
    }
}

TEST(VolumeSequences, namesTheFileThatIsMissingDamagedOrTooFarAway)
{
    const Folder folder;
    std::filesystem::remove(folder.path() + "/a.13.fxvolume");
    EXPECT_NE(refusal(folder.load("")).find("a.13.fxvolume"), std::string::npos) << refusal(folder.load(""));
    folder.write("a.13.fxvolume", asset::writeVolume(frameOf(3))->substr(0, 500));
    EXPECT_NE(refusal(folder.load("")).find("a.13.fxvolume"), std::string::npos) << refusal(folder.load(""));
    base::VoxelVolume other = frameOf(3);
    other.origin.y += 8.0f * kSide * 127.0f;
    folder.writeFrame(3, other);
    EXPECT_NE(refusal(folder.load("")).find("a.13.fxvolume\": the frames together"), std::string::npos)
        << refusal(folder.load(""));
    other.side *= 1.01f; // on its own lattice
    folder.writeFrame(3, other);
    EXPECT_NE(refusal(folder.load("")).find("a.12.fxvolume\": the frame and those beside it"),
              std::string::npos)
        << refusal(folder.load(""));
    folder.writeFrame(3, frameOf(3));
    EXPECT_EQ(refusal(folder.load("")), "loaded");
}

TEST(VolumeSequences, aFileThatChangesWhileItIsPlayedIsAnError)
{
    const Folder folder;
    asset::SequenceFiles files;
    files.pattern = "a.%d.fxvolume";
    files.first = 10;
    files.count = kFrames;
    files.memory = 3 * frameOf(0).bytes();
    const asset::AssetResolver resolver(folder.path(), {});
    base::AssetTable table(std::pmr::get_default_resource());
    asset::AssetLoader loader(resolver, table, asset::MissingAsset::IsAnError);
    const auto id = loader.sequence(files);
    ASSERT_TRUE(id.ok()) << id.status().message();
    EXPECT_EQ(*loader.sequence(files), *id) << "of the same files there is one";
    const auto sequence = table.sequence(*id);
    EXPECT_LE(sequence->counts().bytes, files.memory);
    EXPECT_TRUE(sequence->wait(4).ok());
    folder.writeFrame(3, frameOf(2));
    const base::Status changed = sequence->wait(3).status();
    EXPECT_NE(changed.message().find("a.13.fxvolume\": the file has changed"), std::string::npos)
        << changed.message();
    files.memory = 3 * frameOf(0).bytes() - 1;
    const base::Status small = loader.sequence(files).status();
    EXPECT_EQ(small.code(), base::Code::TooLarge);
    EXPECT_NE(small.message().find("memory"), std::string::npos) << small.message();
}

TEST(VolumeSequences, ofAHostsReaderAreHeldAsAWhole)
{
    const std::string bytes = *asset::writeVolume(frameOf(0));
    const asset::ReadHook hook{
        const_cast<std::string*>(&bytes),
        [](void* user, const char*, uint64_t, void (*deliver)(void*, const void*, size_t), void* sink) {
            const auto& own = *static_cast<const std::string*>(user);
            deliver(sink, own.data(), own.size());
            return 0;
        }};
    const asset::AssetResolver resolver("", {}, hook);
    base::AssetTable table(std::pmr::get_default_resource());
    asset::AssetLoader loader(resolver, table, asset::MissingAsset::IsAnError);
    asset::SequenceFiles files;
    files.pattern = "b.%d.fxvolume";
    files.count = kFrames;
    files.memory = kFrames * frameOf(0).bytes() - 1;
    EXPECT_EQ(loader.sequence(files).status().code(), base::Code::TooLarge);
    ++files.memory;
    const auto id = loader.sequence(files);
    ASSERT_TRUE(id.ok()) << id.status().message();
    for (uint32_t i = 0; i < kFrames; ++i)
        EXPECT_TRUE(table.sequence(*id)->find(i));
}

TEST(VolumeSequences, withoutVelocitiesAreCrossFadedWithAWarning)
{
    const Folder with, without(false);
    std::vector<preset::Diagnostic> diagnostics;
    ASSERT_TRUE(with.load("", &diagnostics).ok());
    EXPECT_TRUE(diagnostics.empty());
    const auto loaded = without.load("", &diagnostics);
    ASSERT_TRUE(loaded.ok());
    EXPECT_FALSE(defOf(*loaded).sequence->hasVelocities());
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_NE(diagnostics[0].message.find("cross-faded"), std::string::npos);
}
