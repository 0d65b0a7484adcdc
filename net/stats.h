// What a process tells about itself: the counts of its bus and its memory, as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "net/bus.h"

namespace phare {

/// {"process", "start_id", "bus": {"cockpit_state": {"received", "lost", "late", "duplicate", "restarted"}, …,
/// "refused", "refused_in_kernel", "refused_because": {…}, "sent": {…}}, "memory": {"rss_kib", "peak_kib"}}. Messages
/// this process does not receive are left out.
nlohmann::json stats_json(const char* process, const Bus& bus);

/// Writes a file whole or not at all (beside it, then renamed); false when it cannot.
bool write_json(const std::filesystem::path& path, const nlohmann::json& json);

}  // namespace phare
