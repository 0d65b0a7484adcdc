#include "cockpit_io/can_log.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "config/base/remedies.h"
#include "config/base/shell_word.h"

namespace phare {
namespace {

// Each frame as a line of candump; what went wrong as a comment that we look for.
constexpr const char* kConverter = R"python(
import os, re, struct, sys
from decimal import Decimal
# An ASC log whose stamps count from the event above, of whatever kind; python-can takes each as counted from the begin.
class AddedUp:
    def __init__(self, path): self.lines, self.sum = open(path, errors="replace"), Decimal(0)
    def __iter__(self): return self
    def __next__(self):
        line = next(self.lines)
        event = re.match(r"\s*(\d+\.\d+)(?=\s)", line)
        if not event: return re.sub(r"(timestamps\s+)relative", r"\1absolute", line, flags=re.I)
        self.sum += Decimal(event[1])
        return format(self.sum, "f") + line[event.end():]
    def read(self): raise OSError("is read by lines")  # python-can takes for a file what has read and write
    def write(self): raise OSError("is not written")
    def close(self): self.lines.close()
def is_relative(path):
    if not path.lower().endswith(".asc"): return False
    with open(path, errors="replace") as lines:
        for line in lines:
            if re.match(r"\s*\d+\.\d+\s", line): break
            if re.match(r"\s*base\s+\w+\s+timestamps\s+relative", line, re.I): return True
    return False
# Of a BLF file that ends before its header or its last object says; python-can reads on to the end of what is there.
def cut_off(path):
    if not path.lower().endswith(".blf"): return ""
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        head = file.read(24)
        if len(head) < 24: return ""
        _, at, said = struct.unpack("<4sL8xQ", head)
        if said > size: return "the file is cut off, %d of its %d bytes are there" % (size, said)
        while at + 16 <= size:
            file.seek(at)
            mark, _, _, length, _ = struct.unpack("<4sHHLL", file.read(16))
            if mark != b"LOBJ" or length < 16: break
            if at + length > size: return "the file is cut off within its last %d bytes" % (size - at)
            at += length + length % 4
    return ""
def line_of(m):
    channel = re.sub(r"\W", "", "can0" if m.channel is None else str(m.channel)) or "can0"
    if m.is_error_frame:
        ident, body = "%08X" % (0x20000000 | (m.arbitration_id & 0x1FFFFFFF)), "#" + "00" * 8
    else:
        ident, body = ("%08X" if m.is_extended_id else "%03X") % m.arbitration_id, "#" + bytes(m.data).hex().upper()
        if m.is_remote_frame: body = "#R%d" % m.dlc
        elif m.is_fd: body = "##%X" % (int(m.bitrate_switch) | 2 * int(m.error_state_indicator)) + body[1:]
    return "(%.6f) %s %s%s" % (m.timestamp, channel, ident, body)
try:
    import can
except ImportError:
    print("#missing")
    sys.exit()
print("#with python-can " + can.__version__)
try:
    path = sys.argv[1]
    reader = can.ASCReader(AddedUp(path)) if is_relative(path) else can.LogReader(path)
    print("#with python-can " + can.__version__ + ", " + type(reader).__name__)
    for message in reader: print(line_of(message))
    if cut_off(path): print("#failed " + cut_off(path))
except BaseException as problem:
    print("#failed " + (cut_off(sys.argv[1]) or " ".join((str(problem) or type(problem).__name__).split())))
)python";

/// The Pythons to ask, in turn: the one that is named, or that of PATH and then that of Debian's package, which an
/// environment's own may hide.
std::vector<std::string> pythons() {
  const char* named = std::getenv("PHARE_PYTHON");
  if (named != nullptr && *named != '\0') return {named};
  return {"python3", "/usr/bin/python3"};
}

/// Standard output of the converter; nullopt where there is no Python.
std::optional<std::string> convert(const std::filesystem::path& file) {
  std::optional<std::string> newest;
  for (const std::string& python : pythons()) {
    const std::string command = shell_word(python) + " -c " + shell_word(kConverter) + " " +
                                shell_word(std::filesystem::absolute(file).string()) + " 2>/dev/null";
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) continue;
    std::string out;
    std::array<char, 65536> part{};
    for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) out.append(part.data(), n);
    const int status = pclose(pipe);
    if (!out.starts_with('#')) continue;
    if (status != 0) out.append("\n#failed Python was ended before the end of the log");
    newest = std::move(out);
    if (!newest->starts_with("#missing")) break;
  }
  return newest;
}

/// What follows the last "#word " at the beginning of a line.
std::string remark(const std::string& out, const std::string& word) {
  const std::size_t at = out.rfind("#" + word);
  if (at == std::string::npos) return {};
  const std::size_t begin = std::min(at + word.size() + 2, out.size());
  return out.substr(begin, out.find('\n', begin) - begin);
}

}  // namespace

bool reads_foreign_can_logs() {
  return std::ranges::any_of(pythons(), [](const std::string& python) {
    return std::system((shell_word(python) + " -c 'import can' >/dev/null 2>&1").c_str()) == 0;
  });
}

bool is_foreign_can_log(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 4> kForeign{".asc", ".blf", ".trc", ".mf4"};
  return std::ranges::find(kForeign, ending) != kForeign.end();
}

Result<CanLog> read_can_log(const std::filesystem::path& file) {
  if (!is_foreign_can_log(file)) {
    auto log = read_candump(file);
    if (!log) return log.error();
    return CanLog{std::move(*log), {}};
  }
  if (!std::ifstream(file)) return Error{file.string(), "no such file, or it cannot be read"};
  const auto out = convert(file);
  if (!out)
    return Error{file.string(),
                 "a log of this kind is read with Python, which does not start; " + std::string(kCanLogRemedy)};
  if (out->starts_with("#missing"))
    return Error{file.string(), "a log of this kind is read with python-can; " + std::string(kCanLogRemedy)};
  const std::string with = remark(*out, "with"), failed = remark(*out, "failed");
  auto log = parse_candump(*out, file.string());
  if (!log) return Error{file.string(), with + ": " + (failed.empty() ? "holds no CAN frame" : failed)};
  log->counts_frames = true;
  for (std::size_t i = 0; i < log->entries.size(); ++i) log->entries[i].line = static_cast<int>(i) + 1;
  if (!failed.empty()) {
    ++log->broken_lines;
    log->problems.push_back({static_cast<int>(log->entries.size()) + 1, with + " breaks off here: " + failed});
  }
  spdlog::info("{}: {} frames, read with {}", file.string(), log->entries.size(), with);
  return CanLog{std::move(*log), with};
}

}  // namespace phare
