/// @file preset_worker.h
/// Reads messages of a client, and loads the presets that they contain, on a thread of its own.
#pragma once

#include "fxsdk/fx_base.h"
#include "fxsdk/livelink/protocol/link_message.h"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace fx::link {

/// A message of a connection.
struct Job
{
    uint64_t connection = 0;
    uint64_t received = 0; ///< number of the update that received the end of the message
    std::string message;
};

/// A message that has been read.
struct DoneJob
{
    uint64_t connection = 0;
    uint64_t received = 0;
    uint64_t id = 0; ///< number of the request, also of an invalid one; 0: none
    base::Result<Request> request{Request()};
    FxResult loadResult = FX_OK;      ///< of a replacement
    std::string loadMessage;          ///< why loadResult is not FX_OK
    FxPresetId preset{};              ///< loaded preset, owned by the receiver
    std::vector<FxPresetId> replaced; ///< presets that it replaces
    std::string source;               ///< source of these presets
    double milliseconds = 0;          ///< [ms] time of loading
};

class PresetWorker
{
public:
    /// @param hasThread false: add() does the work
    PresetWorker(FxContext* context, bool hasThread);
    /// Waits for the job in work. Presets that take() has not returned are unloaded.
    ~PresetWorker();
    PresetWorker(const PresetWorker&) = delete;
    PresetWorker& operator=(const PresetWorker&) = delete;

    void add(Job job);
    std::optional<DoneJob> take();
    size_t unfinished(); ///< number of jobs that have not been taken
    /// The caller has unloaded a loaded preset.
    void forget(FxPresetId preset);
    /// Presets of the context, without those that were loaded here and, while one is loaded here, without
    /// those that the host has loaded meanwhile.
    std::vector<FxPresetId> listPresets();

private:
    void work();
    DoneJob finish(Job job) noexcept;
    void load(DoneJob& io);
    void keep(DoneJob done);

    FxContext* context_;
    std::mutex mutex_; ///< guards the members below
    std::condition_variable wake_;
    std::deque<Job> waiting_;
    std::deque<DoneJob> done_;
    std::vector<uint64_t> loaded_; ///< bits of presets that were loaded here
    std::vector<uint64_t> known_;  ///< bits of the other presets when the load in work began
    bool isLoading_ = false;
    size_t working_ = 0;
    bool isOver_ = false;
    std::thread thread_; ///< last: uses all others
};

/// Source of a preset, see fxGetPresetSource(); empty if it is not loaded.
std::string sourceOf(FxContext* context, FxPresetId preset);

} // namespace fx::link
