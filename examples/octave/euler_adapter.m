% A code written in Euler angles, as a solver process:
%   ursula validate SCENARIO --solver 'octave-cli --quiet euler_adapter.m FUNCTION CONVENTION'
%
% FUNCTION is yours, a file FUNCTION.m beside this one, in the folder you work in, or on Octave's path:
%   tau = FUNCTION(p, angles, dp, dangles, ddp, ddangles)
% Columns; p and its rates are of the platform's origin in the base's axes; tau are six efforts in motor order. Angles
% are in radians and in the order of their turns. ups_zxz.m and ups_rpy.m are two for a telescopic hexapod.
%
% CONVENTION is three of x, y, z for turns about axes that turn along, so that Q = R1(a1) R2(a2) R3(a3): zxz is Z-X-Z.
% zyx is yaw, pitch, roll about turning axes. rpy is the same rotation with its angles in the order roll, pitch, yaw,
% Q = Rz(yaw) Ry(pitch) Rx(roll). Any other order works too.
1;

function R = turn(axis, angle)
  c = cos(angle);  s = sin(angle);
  switch axis
    case 1, R = [1 0 0; 0 c -s; 0 s c];
    case 2, R = [c 0 s; 0 1 0; -s 0 c];
    case 3, R = [c -s 0; s c 0; 0 0 1];
  end
end

function Q = rotation_of(q)
  q = q / norm(q);
  X = [0 -q(4) q(3); q(4) 0 -q(2); -q(3) q(2) 0];
  Q = eye(3) + 2 * q(1) * X + 2 * X * X;
end

% Axes of the three turns, and the order in which FUNCTION has the angles.
function [axes, order] = convention_of(name)
  order = 1:3;
  if strcmp(name, 'rpy'), name = 'zyx';  order = 3:-1:1; end
  [known, axes] = ismember(lower(name), 'xyz');
  if numel(axes) ~= 3 || ~all(known) || axes(1) == axes(2) || axes(2) == axes(3)
    error('no convention %s: expected rpy, or three of x, y, z with no letter twice in a row', name);
  end
end

% Q = R1 R2 R3. The middle angle is in [0, pi] where the first axis comes again, else in [-pi/2, pi/2].
function a = angles_of(Q, axes)
  [i, j, k] = deal(axes(1), axes(2), axes(3));
  if i == k
    m = 6 - i - j;
    hand = 1 - 2 * (mod(j - i, 3) == 2);  % -1 where i, j, m is left-handed
    a = [atan2(Q(j, i), -hand * Q(m, i)); atan2(hypot(Q(j, i), Q(m, i)), Q(i, i)); atan2(Q(i, j), hand * Q(i, m))];
  else
    hand = 1 - 2 * (mod(j - i, 3) == 2);
    a = [atan2(-hand * Q(j, k), Q(k, k)); atan2(hand * Q(i, k), hypot(Q(i, i), Q(i, j))); atan2(-hand * Q(i, j), Q(i, i))];
  end
end

% omega = E da, alpha = E dda + c. A column of E is an axis where the turns before have brought it.
function [da, dda] = rates_of(a, axes, w, alpha, t)
  unit = eye(3);
  R = turn(axes(1), a(1));
  E = [unit(:, axes(1)), R * unit(:, axes(2)), R * turn(axes(2), a(2)) * unit(:, axes(3))];
  if abs(det(E)) < 1e-6
    error('gimbal lock at t = %.9g s: angles %s rad have no rates there (first and last axis are one line)', ...
          t, mat2str(a.', 9));
  end
  da = E \ w;
  before = [zeros(3, 1), E(:, 1) * da(1), E(:, 1) * da(1) + E(:, 2) * da(2)];
  dE = cross(before, E);
  dda = E \ (alpha - dE * da);
end

% t, p, q, v, w, a, alpha to a row of efforts.
function tau = efforts_of(code, axes, order, in)
  a = angles_of(rotation_of(in(5:8)), axes);
  [da, dda] = rates_of(a, axes, in(12:14), in(18:20), in(1));
  tau = code(in(2:4), a(order), in(9:11), da(order), in(15:17), dda(order));
  if numel(tau) ~= 6, error('expected six efforts, got %d', numel(tau)); end
end

if numel(argv()) < 2, error('usage: octave-cli --quiet euler_adapter.m FUNCTION CONVENTION'); end
addpath(fileparts(mfilename('fullpath')));
code = str2func(argv(){end - 1});
[axes, order] = convention_of(argv(){end});
% Not fgetl: that waits for the line after before it gives one.
while numel(motion = fscanf(stdin, '%f,', 20)) == 20
  printf('%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n', efforts_of(code, axes, order, motion));
  fflush(stdout);
end
