% tau = ups_in_angles(axes, p, angles, dp, dangles, ddp, ddangles): the telescopic hexapod of ups_solver.m as a code
% that knows angles alone, of turns about axes(1), axes(2), axes(3), which turn along. For euler_adapter.m to call.
function tau = ups_in_angles(axes, p, angles, dp, dangles, ddp, ddangles)
  persistent machine
  if isempty(machine)
    functions_alone = true;
    source(fullfile(fileparts(mfilename('fullpath')), 'ups_solver.m'));
    machine = read_machine(getenv('URSULA_SCENARIO'));
  end
  % Each factor with its first and second derivative; their products are Q, Q' and Q''.
  Q = eye(3);  dQ = ddQ = zeros(3);  q = 1;  v = zeros(3, 1);
  for k = 1:3
    u = (1:3 == axes(k)).';
    X = skew(double(u));
    R = expm(angles(k) * X);
    dR = R * X * dangles(k);
    ddR = dR * X * dangles(k) + R * X * ddangles(k);
    ddQ = ddQ * R + 2 * dQ * dR + Q * ddR;
    dQ = dQ * R + Q * dR;
    Q = Q * R;
    c = cos(angles(k) / 2);  s = sin(angles(k) / 2);
    [q, v] = deal(q * c - s * (u.' * v), q * s * u + c * v + s * cross(v, u));
  end
  % Q' Q^T is the matrix of omega, and its derivative that of alpha.
  W = dQ * Q.';
  A = ddQ * Q.' + dQ * dQ.';
  vector = @(X) [X(3, 2) - X(2, 3); X(1, 3) - X(3, 1); X(2, 1) - X(1, 2)] / 2;
  tau = forces(machine, [0; p; q; v; dp; vector(W); ddp; vector(A)]);
end
