#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/shown_text.h"

namespace ursula {

/// Writes to standard error for people, and ignores failures, because only lost data is an error. Control characters
/// are not escaped.
void sayText(const std::string& text);

/// Writes a sentence. Control characters in file names and contents are escaped, to protect the terminal.
template <class... Arguments>
void say(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
  sayText(withoutControls(fmt::format(form, std::forward<Arguments>(arguments)...)));
}

/// Prepares the streams before anything is opened. Streams that the caller closed get a placeholder, so that no file
/// receives text for a terminal; writing to standard output still fails. A closed reader or a file size limit becomes
/// an error of the write instead of a signal.
void secureStreams();

/// Loads early the library that unwinds threads. The C library loads it on demand and aborts if memory is short by
/// then.
void loadUnwinder();

/// If the address space is bounded (`ulimit -v`), makes threads share one arena. glibc reserves 64 MB for each further
/// arena, and repeats failed attempts at every call.
void shareArenaInBoundedMemory();

/// Returns why standard output is incomplete; "" if it is complete.
std::string lostOutput();

}  // namespace ursula
