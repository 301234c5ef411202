#include "simulation/particles/collisions/contact_path.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr int kMaxPushOuts = 4;
constexpr float kSlowShare = 1.0f / 1024; ///< of the speed that the rest of the step takes away

/// [m] how far above an obstacle a particle goes on, so that rounding does not put it inside.
float liftAt(const glm::vec3& p)
{
    const glm::vec3 size = glm::abs(p);
    return std::max(std::max(size.x, std::max(size.y, size.z)) * 0x1p-20f, 1e-6f);
}

void removeInward(glm::vec3& io, const glm::vec3& n)
{
    io -= std::min(glm::dot(io, n), 0.0f) * n;
}

/// Follows one particle from contact to contact.
class Follower
{
public:
    Follower(std::span<const ObstacleEntry> obstacles, const StepContext& step, const glm::vec3& from,
             const ContactState& state, float seconds, ContactList* list)
        : obstacles_(obstacles), step_(step), state_(state), total_(seconds), list_(list)
    {
        const glm::vec3 mean = (state.position - from) / seconds;
        leg_ = {from, state.position, 2.0f * mean - state.velocity, {}, seconds};
        leg_.acceleration = (state.velocity - leg_.velocity) / seconds; // (1)
    }

    ContactState follow()
    {
        pushOut(leg_.from);
        for (int contacts = 0; contacts <= kMaxContacts; ++contacts) {
            const ObstacleEntry* met = nullptr;
            const LegContact contact = firstContact(met);
            if (!met)
                return finish();
            state_.isHit = true;
            if (answer(*met, contact, contacts))
                return state_;
        }
        return stop(leg_.from);
    }

private:
    LegContact firstContact(const ObstacleEntry*& outMet) const
    {
        LegContact first;
        for (const ObstacleEntry& entry : obstacles_) {
            if (!entry.obstacle->isThere(step_))
                continue;
            const LegContact contact = entry.obstacle->meet(step_, leg_);
            if (contact.found && (!outMet || contact.share < first.share)) {
                first = contact;
                outMet = &entry;
            }
        }
        return first;
    }

    /// [1] of the step
    float shareAt(const LegContact& contact) const
    {
        const float spent = total_ - leg_.seconds + contact.share * leg_.seconds;
        return std::clamp(spent / total_, 0.0f, 1.0f);
    }

    /// Whether a particle that meets a surface with `speed` has rested on it or slid along it until now.
    bool hasRested(const LegContact& contact, float speed) const
    {
        const float lift = liftAt(contact.place);
        const float before = std::abs(glm::dot(leg_.velocity, contact.normal));
        return glm::dot(leg_.from - contact.place, contact.normal) <= 2.0f * lift &&
               before < 0.5f * (speed + lift / total_); // of which places are rounded by a quarter at most
    }

    void report(const TileContact& contact)
    {
        if (list_ && contact.speed > restSpeed_ && list_->count < list_->contacts.size())
            list_->contacts[list_->count++] = contact;
    }

    /// @return true when the way ends here
    bool answer(const ObstacleEntry& met, const LegContact& contact, int contacts)
    {
        const float spent = contact.share * leg_.seconds;
        glm::vec3 velocity = leg_.velocity + spent * leg_.acceleration;
        const glm::vec3 place = contact.place + liftAt(contact.place) * contact.normal;
        const float approach = glm::dot(velocity, contact.normal);
        const float speed = std::max(-approach, 0.0f);
        TileContact event{shareAt(contact),       speed,         place, velocity, false,
                          uint32_t(contacts) + 1, contact.normal};
        if (contacts == 0)
            state_.contact = event.share;
        if (met.response != ContactResponse::Bounce) {
            state_.isKilled = met.response == ContactResponse::Kill;
            state_.isStuck = met.response == ContactResponse::Stick;
            stop(contact.place);
            if (state_.isKilled) {
                state_.velocity = velocity;
                state_.contact = event.share;
            }
            event.position = contact.place;
            event.velocity = state_.velocity;
            event.isLast = true;
            report(event);
            return true;
        }
        if (contacts == 0 && hasRested(contact, speed))
            restSpeed_ = speed;
        if (approach < 0.0f)
            velocity = (1.0f - met.friction) * (velocity - approach * contact.normal) -
                       met.restitution * approach * contact.normal; // (2)
        event.velocity = velocity;
        report(event);
        leg_.seconds -= spent;
        const float sinking = -glm::dot(leg_.acceleration, contact.normal) * leg_.seconds;
        const float leaving = glm::dot(velocity, contact.normal);
        if (contacts + 2 >= kMaxContacts || kSlowShare * sinking > leaving) { // (3)
            velocity -= leaving * contact.normal;
            removeInward(leg_.acceleration, contact.normal);
        }
        leg_.from = place;
        leg_.velocity = velocity;
        leg_.to = leg_.at(leg_.seconds);
        if (leg_.seconds > 0.0f)
            return false;
        finish();
        return true;
    }

    ContactState stop(const glm::vec3& place)
    {
        state_.position = place;
        state_.velocity = glm::vec3(0.0f);
        return state_;
    }

    ContactState finish()
    {
        state_.position = leg_.to;
        state_.velocity = leg_.velocity + leg_.seconds * leg_.acceleration;
        if (!pushOut(state_.position))
            state_.position = leg_.from; // (4)
        return state_;
    }

    /// Moves a place out of matter. @return false when it is still inside
    bool pushOut(glm::vec3& io) const
    {
        bool isOut = false;
        for (int k = 0; k < kMaxPushOuts && !isOut; ++k) {
            isOut = true;
            for (const ObstacleEntry& entry : obstacles_) {
                if (!entry.obstacle->isThere(step_))
                    continue;
                const Clearance c = entry.obstacle->clearance(step_, io);
                if (!(c.distance < 0.0f))
                    continue;
                io += (liftAt(io) - c.distance) * c.normal;
                isOut = false;
            }
        }
        return isOut || !isInside(io);
    }
    bool isInside(const glm::vec3& p) const
    {
        return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const ObstacleEntry& entry) {
            return entry.obstacle->isThere(step_) && entry.obstacle->clearance(step_, p).distance < 0.0f;
        });
    }

    std::span<const ObstacleEntry> obstacles_;
    const StepContext& step_;
    ContactState state_;
    ContactLeg leg_{};
    float total_;
    ContactList* list_;
    float restSpeed_ = -1.0f; ///< [m/s] contacts that are not faster do not begin
};

} // namespace

ContactState followPath(std::span<const ObstacleEntry> obstacles, const StepContext& step,
                        const glm::vec3& from, const ContactState& state, float seconds, ContactList* list)
{
    return Follower(obstacles, step, from, state, seconds, list).follow();
}

} // namespace fx::sim
