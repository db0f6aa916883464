% The telescopic hexapod in roll, pitch, yaw: Q = Rz(yaw) Ry(pitch) Rx(roll). For euler_adapter.m ups_rpy rpy.
function tau = ups_rpy(p, angles, dp, dangles, ddp, ddangles)
  tau = ups_in_angles([3 2 1], p, flip(angles), dp, flip(dangles), ddp, flip(ddangles));
end
