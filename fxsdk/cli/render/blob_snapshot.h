/// @file blob_snapshot.h
/// Converts a list of blobs to a snapshot, the input of the GL renderer.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/reference/render/medium_blobs.h"

#include <memory_resource>
#include <span>

namespace fx::cli {

/// Does the inverse of render::mediumOf(). Creates one group for each combination of instance, anisotropy and
/// layer, without procedural detail. Positions are relative to the center of all blobs. Numbers are rounded
/// to floats.
/// @param schema has the kind "blob" and must outlive the snapshot
/// @param sequence must exceed the sequence of every snapshot that the same view has drawn
base::FrameSnapshot snapshotOfBlobs(std::span<const render::MediumBlob> blobs,
                                    const base::SnapshotSchema& schema, uint64_t sequence);

} // namespace fx::cli
