#include "fxsdk/assets/sequence_reader.h"

#include "foundation/math/hash.h"
#include "fxsdk/assets/frame_name.h"
#include "fxsdk/assets/volume_file.h"
#include "rendering/volumes/volume_levels.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace fx::asset {

namespace {

using base::Code;
using base::Status;

constexpr double kSameSide = 1e-5;  // relative difference of sides that counts as rounding
constexpr double kOnLattice = 1e-2; // [voxel] of origins, likewise
constexpr uint64_t kMebibyte = 1 << 20;

Status inFile(std::string_view name, const Status& why)
{
    return {why.code(), "asset \"" + std::string(name) + "\": " + why.message()};
}

/// A lattice of bricks, and a frame's place on it.
struct Lattice
{
    double side = 0.0;      // [m] of a voxel; 0: not known yet
    glm::dvec3 origin{0.0}; // [m] center of the voxel (0, 0, 0) of the first frame
};

/// [brick] From the voxel (0, 0, 0) of the lattice to that of the volume.
base::Result<glm::ivec3> offsetOf(const base::VoxelVolume& volume, const Lattice& lattice)
{
    const auto side = double(volume.side);
    if (!(std::abs(side - lattice.side) <= kSameSide * lattice.side))
        return Status(Code::Schema,
                      "voxels have another side than in the first frame; export all frames with "
                      "the same voxel size");
    const glm::dvec3 bricks =
        (glm::dvec3(volume.origin) - lattice.origin) / (lattice.side * base::kVolumeBrickSide);
    const glm::dvec3 whole = glm::round(bricks);
    for (int a = 0; a < 3; ++a)
        if (!(std::abs(bricks[a] - whole[a]) * base::kVolumeBrickSide <= kOnLattice) ||
            !(std::abs(whole[a]) < 1e6))
            return Status(Code::Schema,
                          "voxels are not on the lattice of the first frame; export all frames with the same "
                          "transform");
    return glm::ivec3(whole);
}

/// What is known of a file after its first reading.
struct KnownFile
{
    std::string name;
    uint64_t hash = 0;
    glm::ivec3 offset{0}; // [brick] of the frame, such that all bricks are in range
};

base::Result<base::VoxelVolume> parseFrame(const std::string& bytes, const KnownFile& file)
{
    base::Result<base::VoxelVolume> volume = parseVolume(bytes);
    if (!volume)
        return inFile(file.name, volume.status());
    return volume;
}

class SequenceReading
{
public:
    SequenceReading(const SequenceFiles& files, const ReadBytes& read) : files_(files), read_(read) {}

    /// The first reading, of lattices and sizes.
    Status measure()
    {
        known_.resize(files_.count);
        for (uint32_t i = 0; i < files_.count; ++i) {
            base::Result<base::VoxelVolume> volume = readFrame(i);
            if (!volume)
                return volume.status();
            if (i == 0)
                lattice_ = {double(volume->side), glm::dvec3(volume->origin)};
            const base::Result<glm::ivec3> offset = offsetOf(*volume, lattice_);
            if (!offset)
                return inFile(known_[i].name, offset.status());
            known_[i].offset = *offset;
            hasVelocities_ = hasVelocities_ && !volume->velocity.empty();
            const auto [low, high] = boxOf(*volume);
            low_ = i == 0 ? low + *offset : glm::min(low_, low + *offset);
            high_ = i == 0 ? high + *offset : glm::max(high_, high + *offset);
            for (int a = 0; a < 3; ++a)
                if (high_[a] - low_[a] >= base::kMaxVolumeBricksPerAxis - 1)
                    return inFile(
                        known_[i].name,
                        {Code::TooLarge, "the frames together have more than " +
                                             std::to_string((base::kMaxVolumeBricksPerAxis - 1) * 8) +
                                             " voxels along an axis: use larger voxels"});
            take(i, *volume);
        }
        return {};
    }

    base::Result<std::shared_ptr<base::VolumeSequence>> finish(ReadBytes readAgain)
    {
        base::VolumeSequence::Def def;
        const glm::ivec3 shift = 1 - low_;
        for (KnownFile& file : known_)
            file.offset += shift;
        def.side = float(lattice_.side);
        def.origin =
            glm::vec3(lattice_.origin - lattice_.side * double(base::kVolumeBrickSide) * glm::dvec3(shift));
        def.hasVelocities = hasVelocities_;
        def.memory = files_.memory;
        def.makeCoarser = render::coarserLevels;
        uint64_t all = 0;
        for (uint32_t i = 0; i < files_.count; ++i) {
            base::VolumeSequence::Frame& frame = frames_[i];
            all += frame.bytes;
            for (base::VolumeCells& cells : frame.cells)
                cells.brick += known_[i].offset;
            for (glm::ivec3& brick : bricks_[i])
                brick += known_[i].offset;
            frame.coarserBytes = render::mostCoarserBytes(std::move(bricks_[i]), frameHasVelocities_[i]);
            if (i < held_.size()) {
                for (glm::ivec3& brick : held_[i].bricks)
                    brick += known_[i].offset;
                def.held.push_back(std::make_shared<const base::VoxelVolume>(std::move(held_[i])));
            }
        }
        const uint64_t least = readAgain ? base::VolumeSequence::leastMemory(frames_) : all;
        if (least > files_.memory)
            return Status(Code::TooLarge, "\"" + files_.pattern + "\": " +
                                              (readAgain ? "three successive frames have "
                                                         : "all frames, which the host "
                                                           "provides, have ") +
                                              std::to_string((least + kMebibyte - 1) / kMebibyte) +
                                              " MiB of voxels; increase \"memory\", or use larger voxels");
        def.frames = std::move(frames_);
        def.read = [files = std::move(known_), read = std::move(readAgain)](
                       uint32_t frame) -> base::Result<base::VolumeSequence::Volume> {
            const KnownFile& file = files[frame];
            const base::Result<std::string> bytes = read(file.name);
            if (!bytes)
                return bytes.status();
            if (base::hashBytes(0, bytes->data(), bytes->size()) != file.hash)
                return inFile(file.name, {Code::Io, "the file has changed since the preset was loaded"});
            base::Result<base::VoxelVolume> volume = parseFrame(*bytes, file);
            if (!volume)
                return volume.status();
            for (glm::ivec3& brick : volume->bricks)
                brick += file.offset;
            return std::make_shared<const base::VoxelVolume>(std::move(*volume));
        };
        return std::make_shared<base::VolumeSequence>(std::move(def));
    }

    uint64_t hash() const { return hash_; }

private:
    static std::pair<glm::ivec3, glm::ivec3> boxOf(const base::VoxelVolume& volume)
    {
        glm::ivec3 low = volume.bricks.front(), high = low;
        for (const glm::ivec3& brick : volume.bricks) {
            low = glm::min(low, brick);
            high = glm::max(high, brick);
        }
        return {low, high};
    }

    base::Result<base::VoxelVolume> readFrame(uint32_t i)
    {
        base::Result<std::string> name = frameName(files_.pattern, files_.first + i);
        if (!name)
            return name.status();
        known_[i].name = std::move(*name);
        const base::Result<std::string> bytes = read_(known_[i].name);
        if (!bytes)
            return Status(bytes.status().code(),
                          "frame " + std::to_string(files_.first + i) + ": " + bytes.status().message());
        known_[i].hash = base::hashBytes(0, bytes->data(), bytes->size());
        hash_ = base::hashWord(hash_, known_[i].hash);
        return parseFrame(*bytes, known_[i]);
    }

    void take(uint32_t i, base::VoxelVolume& volume)
    {
        frames_.push_back({base::volumeCells(volume), volume.bytes(), 0});
        bricks_.push_back(volume.bricks);
        frameHasVelocities_.push_back(!volume.velocity.empty());
        heldBytes_ += frames_.back().bytes;
        if (held_.size() == i && heldBytes_ <= files_.memory)
            held_.push_back(std::move(volume));
    }

    const SequenceFiles& files_;
    const ReadBytes& read_;
    Lattice lattice_;
    glm::ivec3 low_{0}, high_{0}; // [brick] box of all frames, from the voxel (0, 0, 0) of the lattice
    bool hasVelocities_ = true;
    std::vector<KnownFile> known_;
    std::vector<base::VolumeSequence::Frame> frames_;
    std::vector<std::vector<glm::ivec3>>
        bricks_; // of each frame; which coarser ones exist depends on offsets
    std::vector<bool> frameHasVelocities_;
    std::vector<base::VoxelVolume> held_;
    uint64_t heldBytes_ = 0, hash_ = 4;
};

} // namespace

base::Result<std::shared_ptr<base::VolumeSequence>>
readSequence(const SequenceFiles& files, const ReadBytes& read, ReadBytes readAgain, uint64_t& outHash)
{
    SequenceReading reading(files, read);
    if (Status status = reading.measure(); !status)
        return status;
    outHash = base::hashWord(reading.hash(), files.memory);
    return reading.finish(std::move(readAgain));
}

} // namespace fx::asset
