/// @file link_message.h
/// Messages of the live link: JSON objects with a member "type".
///
/// The client begins with
///   {"type": "hello", "protocol": 1, "token": "..."}
/// and gets {"type": "hello", "protocol": 1, "name", "pid", "maxMessageBytes"}. Then, with an "id" that the
/// reply repeats:
///   {"type": "list", "id": 1}
///       -> {"type": "list", "id", "presets": [...], "instances": [...], "instanceCount"}
///   {"type": "replace", "id": 2, "preset": NAME, "text": TEXT, "mode": "seek" or "restart"}
///       -> {"type": "replaced", "id", "preset", "instances", "frames", "milliseconds"}
/// A request that fails gets {"type": "error", "id", "code", "message"}. Unknown members are ignored.
#pragma once

#include "foundation/result/status.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace fx::link {

constexpr uint32_t kProtocol = 1;
constexpr uint64_t kHelloBytes = 4096; ///< longest message before and including the hello

enum class RequestType
{
    Hello,
    List,
    Replace,
};

struct Request
{
    RequestType type = RequestType::Hello;
    uint64_t id = 0;       ///< 0: none
    uint64_t protocol = 0; ///< of a hello
    std::string token;     ///< of a hello
    std::string preset;    ///< name of the preset to be replaced
    std::string text;      ///< its new text
    bool restarts = false; ///< mode of the replacement
};

/// Reads a message of a client.
/// @param outId number of the request, also of an invalid one, if it can be read; otherwise 0
/// @return Parse (not JSON, or not UTF-8), Schema (a member is missing or of another type), TooLarge
base::Result<Request> parseRequest(std::string_view message, uint64_t& outId);

/// Reads a message of a game. @return Parse, Schema, TooLarge
base::Result<nlohmann::json> parseReply(std::string_view message);

/// Text of a message. Bytes that are not UTF-8 are replaced.
std::string textOf(const nlohmann::json& message);

nlohmann::json helloMessage(const std::string& token);
nlohmann::json replaceMessage(uint64_t id, const std::string& preset, const std::string& text, bool restarts);
nlohmann::json errorMessage(uint64_t id, const std::string& code, const std::string& message);

} // namespace fx::link
