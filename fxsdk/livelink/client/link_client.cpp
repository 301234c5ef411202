#include "fxsdk/livelink/client/link_client.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace fx::link {

namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr size_t kReadsPerUpdate = 64;

double secondsUntil(Clock::time_point end)
{
    return std::chrono::duration<double>(end - Clock::now()).count();
}

Clock::time_point after(double seconds)
{
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

base::Status refusalOf(const Json& message)
{
    return {base::Code::InvalidArgument, "the game refuses: " + message.value("message", std::string())};
}

} // namespace

base::Result<std::unique_ptr<LinkClient>> LinkClient::connect(const Address& address,
                                                              const std::string& token)
{
    base::Result<Socket> socket = Socket::connect(address);
    if (!socket)
        return socket.status();
    std::unique_ptr<LinkClient> client(new LinkClient(std::move(*socket)));
    client->out_ = frameOf(textOf(helloMessage(token)));
    return client;
}

base::Status LinkClient::send(const Json& message)
{
    const std::string text = textOf(message);
    if (text.size() > longest_)
        return {base::Code::TooLarge, "the message has " + std::to_string(text.size()) +
                                          " bytes; the game accepts " + std::to_string(longest_)};
    out_ += frameOf(text);
    return {};
}

base::Status LinkClient::update()
{
    while (!out_.empty()) {
        const base::Result<size_t> count = socket_.send(out_);
        if (!count) {
            (void)receive(); // perhaps the reason why the game has closed the connection
            return count.status();
        }
        if (*count == 0)
            break;
        out_.erase(0, *count);
    }
    return receive();
}

base::Status LinkClient::receive()
{
    std::array<char, 65536> chunk;
    base::Status end;
    for (size_t i = 0; i < kReadsPerUpdate && end.ok(); ++i) {
        const base::Result<size_t> count = socket_.receive(chunk.data(), chunk.size());
        if (!count)
            end = count.status();
        else if (*count == 0)
            break;
        else
            reader_.add({chunk.data(), *count});
    }
    while (true) {
        base::Result<std::optional<std::string>> message = reader_.take();
        if (!message)
            return message.status();
        if (!*message)
            return end;
        base::Result<Json> reply = parseReply(**message);
        if (!reply)
            return reply.status();
        note(*reply);
        messages_.push_back(std::move(*reply));
    }
}

void LinkClient::note(const Json& message)
{
    if (message["type"] != "hello")
        return;
    if (const auto name = message.find("name"); name != message.end() && name->is_string())
        game_ = *name;
    if (const auto most = message.find("maxMessageBytes");
        most != message.end() && most->is_number_unsigned())
        longest_ = std::min(kLargestMessage, most->get<uint64_t>());
}

Json LinkClient::take()
{
    if (messages_.empty())
        return {};
    Json message = std::move(messages_.front());
    messages_.pop_front();
    return message;
}

base::Result<Json> LinkClient::wait(double seconds)
{
    const Clock::time_point end = after(seconds);
    while (true) {
        const base::Status status = update();
        if (!messages_.empty())
            return take();
        if (!status)
            return status;
        const double left = secondsUntil(end);
        if (left <= 0.0)
            return base::Status(base::Code::Interrupted, "the game does not answer");
        socket_.wait(std::min(left, 0.25), !out_.empty());
    }
}

base::Result<Json> LinkClient::waitForHello(double seconds)
{
    base::Result<Json> reply = wait(seconds);
    if (reply && (*reply)["type"] != "hello")
        return refusalOf(*reply);
    return reply;
}

base::Result<Json> askForList(const Address& address, const std::string& token, double seconds)
{
    const Clock::time_point end = after(seconds);
    base::Result<std::unique_ptr<LinkClient>> client = LinkClient::connect(address, token);
    if (!client)
        return client.status();
    if (const auto hello = (*client)->waitForHello(seconds); !hello)
        return hello.status();
    if (base::Status status = (*client)->send({{"type", "list"}, {"id", 1}}); !status)
        return status;
    base::Result<Json> list = (*client)->wait(std::max(secondsUntil(end), 0.0));
    if (list && (*list)["type"] != "list")
        return refusalOf(*list);
    return list;
}

} // namespace fx::link
