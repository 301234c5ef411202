#include "fxsdk/livelink/client/live_edit.h"

#include <utility>

namespace fx::link {

namespace {

using Json = nlohmann::json;

constexpr double kRetrySeconds = 1.0;
constexpr double kListSeconds = 1.0;

uint64_t numberOf(const Json& message, const char* name)
{
    const auto found = message.find(name);
    return found != message.end() && found->is_number_unsigned() ? found->get<uint64_t>() : 0;
}

std::string wordsOf(const Json& message)
{
    const auto found = message.find("message");
    return found != message.end() && found->is_string() ? found->get<std::string>() : std::string();
}

} // namespace

void LiveEdit::start(const Address& address, const std::string& token, const std::string& preset)
{
    stop();
    address_ = address;
    token_ = token;
    preset_ = preset;
    state_ = LinkState::Connecting;
    untilRetry_ = 0;
}

void LiveEdit::stop()
{
    if (!offered_) // a later connection shows it too
        offered_ = std::move(sent_);
    sent_.reset();
    client_.reset();
    state_ = LinkState::Off;
    message_.clear();
    inFlight_ = listRequest_ = 0;
    list_ = nullptr;
    outcome_ = {};
}

void LiveEdit::offer(std::string text, uint64_t revision)
{
    offered_ = Text{std::move(text), revision};
}

void LiveEdit::connect()
{
    auto client = LinkClient::connect(address_, token_);
    if (!client)
        return lose(client.status().message());
    client_ = std::move(*client);
}

/// Tries again in a second. The text that the game did not confirm is sent again.
void LiveEdit::lose(const std::string& why)
{
    client_.reset();
    state_ = LinkState::Connecting;
    message_ = why;
    untilRetry_ = kRetrySeconds;
    inFlight_ = listRequest_ = 0;
    list_ = nullptr;
    if (!offered_)
        offered_ = std::move(sent_);
    sent_.reset();
}

void LiveEdit::take(const Json& message)
{
    const std::string type = message["type"];
    const uint64_t id = numberOf(message, "id");
    if (type == "hello") {
        state_ = LinkState::Connected;
        message_.clear();
        untilList_ = 0;
        ++connections_;
    } else if (type == "list" && id == listRequest_) {
        list_ = message;
        listRequest_ = 0;
    } else if (id != 0 && id == inFlight_) {
        inFlight_ = 0;
        outcome_ = {sent_ ? sent_->revision : 0,    type == "replaced",          wordsOf(message),
                    numberOf(message, "instances"), numberOf(message, "frames"), flight_ * 1e3};
    } else if (type == "error" && id == 0) {
        message_ = wordsOf(message);
    }
}

void LiveEdit::sendNewest()
{
    if (!offered_ || inFlight_ != 0)
        return;
    sent_ = std::exchange(offered_, std::nullopt);
    const uint64_t id = ++requests_;
    if (const base::Status status = client_->send(replaceMessage(id, preset_, sent_->text, false)); !status) {
        outcome_ = {sent_->revision, false, status.message(), 0, 0, 0};
        return;
    }
    inFlight_ = id;
    flight_ = 0;
}

void LiveEdit::askList(double seconds)
{
    untilList_ -= seconds;
    if (untilList_ > 0 || listRequest_ != 0)
        return;
    untilList_ = kListSeconds;
    listRequest_ = ++requests_;
    (void)client_->send({{"type", "list"}, {"id", listRequest_}});
}

void LiveEdit::update(double seconds)
{
    if (state_ == LinkState::Off)
        return;
    flight_ += seconds;
    untilRetry_ -= seconds;
    if (!client_ && untilRetry_ <= 0)
        connect();
    if (!client_)
        return;
    if (state_ == LinkState::Connected) {
        sendNewest();
        askList(seconds);
    }
    const base::Status status = client_->update();
    for (Json message = client_->take(); !message.is_null(); message = client_->take())
        take(message);
    if (!status) {
        const std::string why = message_.empty() ? status.message() : message_;
        return lose(why);
    }
    if (state_ == LinkState::Connected && inFlight_ == 0 && offered_) { // a reply has made room
        sendNewest();
        if (const base::Status sent = client_->update(); !sent)
            lose(sent.message());
    }
}

} // namespace fx::link
