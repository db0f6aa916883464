#include "parts/fast/batch_dynamics.h"

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "parts/fast/fast_dynamics.h"
#include "parts/fast/kernels/functions_of.h"
#include "parts/fast/kernels/machine_fields.h"

namespace ursula {
namespace {

static_assert(sizeof(Motion<double>) == 25 * sizeof(double), "a batch reads motions as rows of numbers");
static_assert(sizeof(Vector6d) == 6 * sizeof(double));

/// Flags answers that are not finite and sets them to NaN.
void flagNotFinite(std::size_t count, Vector6d* out, PoseFault* faults) {
  for (std::size_t k = 0; k < count; ++k)
    if (faults[k] == PoseFault::none && !out[k].allFinite()) {
      faults[k] = PoseFault::not_finite;
      out[k].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
}

/// Computes one answer after the other.
template <class F>
void oneByOne(std::size_t count, Vector6d* out, PoseFault* faults, const F& answer) {
  for (std::size_t k = 0; k < count; ++k) {
    faults[k] = PoseFault::none;
    out[k].setConstant(std::numeric_limits<double>::quiet_NaN());
    try {
      out[k] = answer(k);
    } catch (const OutOfStroke&) {
      faults[k] = PoseFault::end_of_stroke;
    } catch (const OutOfReach&) {
      faults[k] = PoseFault::out_of_reach;
    } catch (const PointOnAxis&) {
      faults[k] = PoseFault::point_on_axis;
    } catch (const StretchedLeg&) {
      faults[k] = PoseFault::stretched_leg;
    } catch (const SingularJacobian&) {
      faults[k] = PoseFault::singular_jacobian;
    }
  }
}

}  // namespace

struct BatchDynamics::Impl {
  Impl(const kernel::MachineModel<double>& model, InstructionSet with)
      : set(with), single(model, with), functions(kernel::functionsOf(with)) {
    if (!functions) return;
    std::vector<double> numbers;
    kernel::forEachNumber(model, [&numbers](double number) { numbers.push_back(number); });
    machine = functions->make(numbers.data(), kernel::shapeOf(model));
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (functions) functions->destroy(machine);
  }

  InstructionSet set;
  FastDynamics<double> single;
  std::optional<kernel::BatchFunctions> functions;
  void* machine = nullptr;
};

BatchDynamics::BatchDynamics(const Manipulator& manipulator, InstructionSet set)
    : BatchDynamics(kernel::machineModel(MachineParameters<double>(manipulator)), set) {}
BatchDynamics::BatchDynamics(const kernel::MachineModel<double>& machine, InstructionSet set) {
  if (!isSupported(set)) throw std::invalid_argument(std::string("this processor has no ") + nameOf(set));
  impl_ = std::make_shared<const Impl>(machine, set);
}

InstructionSet BatchDynamics::instructionSet() const { return impl_->set; }

namespace {

const double* numbersOf(const Vector6d* vectors) { return vectors != nullptr ? vectors->data() : nullptr; }

}  // namespace

void BatchDynamics::inverseDynamics(const Motion<double>* motions, std::size_t count, Vector6d* efforts,
                                    PoseFault* faults, const Vector6d* loads) const {
  if (count == 0) return;
  if (!impl_->functions)
    oneByOne(count, efforts, faults, [&](std::size_t k) {
      return impl_->single.inverseDynamics(motions[k], loads != nullptr ? loads[k] : Vector6d::Zero());
    });
  else
    impl_->functions->inverse(impl_->machine, {count, &motions->t, nullptr, numbersOf(loads), efforts->data(),
                                               reinterpret_cast<std::uint8_t*>(faults)});
  flagNotFinite(count, efforts, faults);
}

void BatchDynamics::directDynamics(const Motion<double>* motions, const Vector6d* efforts, std::size_t count,
                                   Vector6d* twist_rates, PoseFault* faults, const Vector6d* loads) const {
  if (count == 0) return;
  if (!impl_->functions)
    oneByOne(count, twist_rates, faults, [&](std::size_t k) {
      return impl_->single.directDynamics(motions[k], efforts[k], loads != nullptr ? loads[k] : Vector6d::Zero());
    });
  else
    impl_->functions->direct(impl_->machine, {count, &motions->t, numbersOf(efforts), numbersOf(loads),
                                              twist_rates->data(), reinterpret_cast<std::uint8_t*>(faults)});
  flagNotFinite(count, twist_rates, faults);
}

}  // namespace ursula
