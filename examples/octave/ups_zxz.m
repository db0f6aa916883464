% The telescopic hexapod in Euler angles Z-X-Z: Q = Rz(a1) Rx(a2) Rz(a3). For euler_adapter.m ups_zxz zxz.
function tau = ups_zxz(varargin)
  tau = ups_in_angles([3 1 3], varargin{:});
end
