#include "fxsdk/assets/sequence_reader.h"

#include "foundation/math/hash.h"
#include "fxsdk/assets/frame_name.h"
#include "fxsdk/assets/volume_file.h"
#include "rendering/volumes/volume_levels.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fx::asset {

namespace {

using base::Code;
using base::Status;

constexpr double kSameSide = 1e-5;  // relative difference of sides that counts as rounding
constexpr double kOnLattice = 1e-2; // [voxel] of origins, likewise
constexpr double kFarthest = 1e6;   // [brick]
constexpr uint64_t kMebibyte = 1 << 20;

Status inFile(std::string_view name, const Status& why)
{
    return {why.code(), "asset \"" + std::string(name) + "\": " + why.message()};
}

/// [brick] From the voxel (0, 0, 0) of the lattice to that of another; nothing if it is no whole number, or
/// if voxels have another side.
std::optional<glm::ivec3> offsetOf(const base::VolumeLattice& own, const base::VolumeLattice& lattice)
{
    if (!(std::abs(own.side - lattice.side) <= kSameSide * lattice.side))
        return std::nullopt;
    const glm::dvec3 bricks = (own.origin - lattice.origin) / (lattice.side * base::kVolumeBrickSide);
    const glm::dvec3 whole = glm::round(bricks);
    for (int a = 0; a < 3; ++a)
        if (!(std::abs(bricks[a] - whole[a]) * base::kVolumeBrickSide <= kOnLattice) ||
            !(std::abs(whole[a]) < kFarthest))
            return std::nullopt;
    return glm::ivec3(whole);
}

/// [brick] A box of bricks, both ends included.
struct BrickBox
{
    glm::ivec3 low{0}, high{0};

    void add(const BrickBox& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
};

BrickBox boxOf(const base::VoxelVolume& volume)
{
    BrickBox box{volume.bricks.front(), volume.bricks.front()};
    for (const glm::ivec3& brick : volume.bricks)
        box.add({brick, brick});
    return box;
}

/// The bricks whose cells have medium of a box of bricks of another lattice, see base::cellsOn().
BrickBox cellsBoxOn(const base::VolumeLattice& to, const BrickBox& box, const base::VolumeLattice& from)
{
    constexpr double kBrick = base::kVolumeBrickSide;
    const base::LatticeMap map(from, to);
    const glm::dvec3 low = map(kBrick * glm::dvec3(box.low - 1)) / kBrick;
    const glm::dvec3 high = map(kBrick * glm::dvec3(box.high + 1)) / kBrick;
    return {glm::ivec3(glm::floor(glm::clamp(low, -kFarthest, kFarthest))),
            glm::ivec3(glm::floor(glm::clamp(high, -kFarthest, kFarthest)))};
}

/// What is known of a file after its first reading.
struct KnownFile
{
    std::string name;
    uint64_t hash = 0;
    glm::ivec3 offset{0}; // [brick] from the file to the lattice on which all bricks are in range
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
            hasVelocities_ = hasVelocities_ && !volume->velocity.empty();
            lattices_.push_back({glm::dvec3(volume->origin), double(volume->side)});
            boxes_.push_back(boxOf(*volume));
            take(i, *volume);
        }
        return placeOnOneLattice() ? placeAll() : placeEach();
    }

    base::Result<std::shared_ptr<base::VolumeSequence>> finish(ReadBytes readAgain)
    {
        base::VolumeSequence::Def def;
        def.hasVelocities = hasVelocities_;
        def.memory = files_.memory;
        def.makeCoarser = render::coarserLevels;
        uint64_t all = 0;
        for (uint32_t i = 0; i < files_.count; ++i) {
            base::VolumeSequence::Frame& frame = frames_[i];
            all += frame.bytes;
            frame.lattice = lattices_[i];
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
    /// Finds the bricks of all frames on the lattice of the first, if they are on it.
    bool placeOnOneLattice()
    {
        for (uint32_t i = 0; i < files_.count; ++i) {
            const std::optional<glm::ivec3> offset = offsetOf(lattices_[i], lattices_[0]);
            if (!offset)
                return false;
            known_[i].offset = *offset;
        }
        return true;
    }

    /// Moves all frames together, such that their bricks are in range.
    Status placeAll()
    {
        BrickBox all;
        for (uint32_t i = 0; i < files_.count; ++i) {
            const glm::ivec3 offset = known_[i].offset;
            const BrickBox own{boxes_[i].low + offset, boxes_[i].high + offset};
            i == 0 ? void(all = own) : all.add(own);
            for (int a = 0; a < 3; ++a)
                if (all.high[a] - all.low[a] >= base::kMaxVolumeBricksPerAxis - 1)
                    return inFile(known_[i].name, tooWide("the frames together"));
        }
        for (KnownFile& file : known_)
            file.offset += 1 - all.low;
        shift(lattices_[0], 1 - all.low);
        std::ranges::fill(lattices_, base::VolumeLattice(lattices_[0]));
        return {};
    }

    /// Moves the bricks of each frame, such that also those of the frames that are shown with it are in
    /// range.
    Status placeEach()
    {
        const uint32_t count = files_.count;
        std::vector<base::VolumeLattice> shifted = lattices_;
        for (uint32_t i = 0; i < count; ++i) {
            BrickBox box{boxes_[i].low - 1, boxes_[i].high};
            for (const uint32_t other : {(i + count - 1) % count, (i + 1) % count})
                if (base::VolumeSequence::isNear(lattices_[i], lattices_[other]))
                    box.add(cellsBoxOn(lattices_[i], boxes_[other], lattices_[other]));
            for (int a = 0; a < 3; ++a)
                if (box.high[a] - box.low[a] >= base::kMaxVolumeBricksPerAxis)
                    return inFile(known_[i].name, tooWide("the frame and those beside it"));
            known_[i].offset = -box.low;
            shift(shifted[i], known_[i].offset);
        }
        lattices_ = std::move(shifted);
        return {};
    }

    static Status tooWide(const std::string& frames)
    {
        return {Code::TooLarge, frames + " have more than " +
                                    std::to_string((base::kMaxVolumeBricksPerAxis - 1) * 8) +
                                    " voxels along an axis: use larger voxels"};
    }

    /// @param way [brick] that bricks move
    static void shift(base::VolumeLattice& io, const glm::ivec3& way)
    {
        io.origin -= io.side * double(base::kVolumeBrickSide) * glm::dvec3(way);
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
    std::vector<base::VolumeLattice> lattices_; // of each frame
    std::vector<BrickBox> boxes_;               // of each frame, as in its file
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
