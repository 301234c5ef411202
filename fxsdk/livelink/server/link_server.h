/// @file link_server.h
/// Serves one client of a live link, a bounded amount in each update.
///
/// Threads: the scene thread.
#pragma once

#include "fxsdk/fx_livelink.h"
#include "fxsdk/livelink/protocol/link_socket.h"
#include "fxsdk/livelink/protocol/message_frame.h"
#include "fxsdk/livelink/server/preset_worker.h"

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace fx::link {

/// Options of a server, checked.
struct ServerOptions
{
    std::string name;
    std::string token; ///< empty: none
    bool loadsOnUpdate = false;
    uint64_t maxMessageBytes = 0;
    uint32_t bytesPerUpdate = 0;
    uint32_t messagesPerUpdate = 0;
};

class LinkServer
{
public:
    /// @param listener listens at `address`
    LinkServer(FxContext* context, ServerOptions options, Socket listener, Address address);
    ~LinkServer();
    LinkServer(const LinkServer&) = delete;
    LinkServer& operator=(const LinkServer&) = delete;

    void update(std::span<FxScene* const> scenes);
    void closeClient() { client_.reset(); }
    const Address& address() const { return address_; }
    FxLiveLinkStatistics statistics() const;

private:
    using Clock = std::chrono::steady_clock;
    struct Client
    {
        Client(Socket made, uint64_t number)
            : socket(std::move(made)), connection(number), reader(kHelloBytes)
        {}

        Socket socket;
        uint64_t connection;
        FrameReader reader;
        std::string out;            ///< bytes that are not written yet
        bool isKnown = false;       ///< has said hello
        bool isLeaving = false;     ///< is closed when `out` is written
        Clock::time_point deadline; ///< of the hello, or of the rest of a message
        bool hasDeadline = true;
    };

    void acceptClients();
    void finishJobs(std::span<FxScene* const> scenes);
    void answer(const DoneJob& job, std::span<FxScene* const> scenes);
    nlohmann::json listOf(uint64_t id, std::span<FxScene* const> scenes);
    nlohmann::json replace(const DoneJob& job, std::span<FxScene* const> scenes);
    void readClient();
    void takeMessages();
    void takeMessage(std::string message);
    void greet(const std::string& message);
    void refuse(const std::string& code, const std::string& why);
    void send(const nlohmann::json& message);
    void writeClient();

    FxContext* context_;
    ServerOptions options_;
    Socket listener_;
    Address address_;
    std::unique_ptr<Client> client_;
    uint64_t updates_ = 0;
    uint32_t messagesLeft_ = 0; ///< of this update
    FxLiveLinkStatistics counts_{};
    PresetWorker worker_; ///< last: its thread uses the context
};

} // namespace fx::link
