#pragma once

#include <pybind11/pybind11.h>

namespace ursula::python {

/// Whether the interpreter is ending. Work without its lock then has to stop.
bool isEnding();

/// Releases Python's lock for work without Python. Python ends a daemon thread at its next attempt to take the lock, by
/// an unwinding that C++ answers with an abort. So once the interpreter ends, this holds the thread for ever instead.
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Takes Python's lock within such work, on any thread.
class Locked {
 public:
  Locked();
  ~Locked() { PyGILState_Release(state_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Calls a Python function with one argument. Returns a new reference, null after an exception.
PyObject* called(PyObject* function, PyObject* argument);

/// Lets the interpreter's end wait until such work has stopped. Called once.
void stopWorkAtEnd();

}  // namespace ursula::python
