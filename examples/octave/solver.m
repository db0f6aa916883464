% The paper's torques in Octave, as a process: ursula validate SCENARIO --solver 'octave-cli --quiet solver.m [ERROR]'
%
% Virtual work with the velocity of each leg's end, for legs of the paper's kind (U-R-S) that are all alike, without
% friction and load: a scenario such as scenarios/paper-helix.toml. ERROR is put into the torques, relative.
1;

function values = numbers(text, key)
  % One row for each `key = 1.0` or `key = [1.0, …]`.
  found = regexp(text, ['\<' key '\s*=\s*\[?([-+.\deE, ]+)'], 'tokens');
  values = cell2mat(cellfun(@(each) sscanf(strrep(each{1}, ',', ' '), '%f').', found(:), 'UniformOutput', false));
end

function part = section(text, from, to)
  part = regexp(text, [from '(.*?)' to], 'tokens', 'once'){1};
end

function machine = read_machine(file)
  text = regexprep(fileread(file), '#[^\n]*', '');
  platform = section(text, '\[manipulator\.platform\]', '\n\[');
  links = {section(text, 'proximal\s*=\s*\{', '\}'), section(text, 'distal\s*=\s*\{', '\}')};
  machine.g = numbers(text, 'gravity').';
  machine.m = numbers(platform, 'mass');
  machine.rho = numbers(platform, 'center_of_mass').';
  machine.I = diag(numbers(platform, 'inertia'));
  for k = 1:2
    machine.link(k) = struct('l', numbers(links{k}, 'length'), 'm', numbers(links{k}, 'mass'), ...
                             'c', numbers(links{k}, 'center_of_mass'), 'I', diag(numbers(links{k}, 'inertia')));
  end
  machine.a = numbers(text, 'base_point').';
  machine.u = numbers(text, 'base_axis').';
  machine.u = machine.u ./ sqrt(sum(machine.u .^ 2));
  machine.b = numbers(text, 'platform_point').';
end

function X = skew(v)
  X = [0 -v(3) v(2); v(3) 0 -v(1); -v(2) v(1) 0];
end

function Q = rotation(q)
  X = skew(q(2:4));
  Q = eye(3) + 2 * q(1) * X + 2 * X * X;
end

% C with v_B = C [φ̇; ψ̇; χ̇]: φ about −u, the two links turning by ψ and χ about x. Rows of G: rates for v_B.
function [row, F] = leg(machine, u, r, v_B, a_B)
  [p, d] = machine.link.l;
  z = r - u * (u.' * r);  z /= norm(z);  x = skew(u) * z;
  cosine = (p^2 + d^2 - r.' * r) / (2 * p * d);  sine = sqrt(1 - cosine^2);
  psi = atan2(r.' * z, r.' * u) + atan2(d * sine, p - d * cosine);
  e = cos(psi) * u + sin(psi) * z;
  s = -cosine * e - sine * skew(x) * e;
  C = [-skew(u) * r, p * skew(x) * e, d * skew(x) * s];
  rate = C \ v_B;
  w = -rate(1) * u;  w1 = w + rate(2) * x;  w2 = w + rate(3) * x;
  W = skew(w);  W1 = skew(w1);  W2 = skew(w2);
  bias = W * v_B + p * rate(2) * (skew(W * x) * e + skew(x) * (W1 * e)) + ...
         d * rate(3) * (skew(W * x) * s + skew(x) * (W2 * s));
  acc = C \ (a_B - bias);
  w1_dot = -acc(1) * u + acc(2) * x + rate(2) * W * x;
  w2_dot = -acc(1) * u + acc(3) * x + rate(3) * W * x;
  e_ddot = (skew(w1_dot) + W1 * W1) * e;
  s_ddot = (skew(w2_dot) + W2 * W2) * s;
  k1 = machine.link(1);  k2 = machine.link(2);
  f1 = k1.m * (k1.c * e_ddot - machine.g);
  f2 = k2.m * (p * e_ddot + k2.c * s_ddot - machine.g);
  E = [x, skew(e) * x, e];  I1 = E * k1.I * E.';
  S = [x, skew(s) * x, s];  I2 = S * k2.I * S.';
  n1 = I1 * w1_dot + W1 * I1 * w1;
  n2 = I2 * w2_dot + W2 * I2 * w2;
  work = [-u.' * (skew(k1.c * e) * f1 + n1 + skew(p * e + k2.c * s) * f2 + n2)
          (skew(x) * e).' * (k1.c * f1 + p * f2) + x.' * n1
          (skew(x) * s).' * (k2.c * f2) + x.' * n2];
  F = C.' \ work;
  row = [1 0 0] / C;
end

function tau = torques(machine, in)
  p = in(2:4);  Q = rotation(in(5:8));  v = in(9:11);  w = in(12:14);  a = in(15:17);  alpha = in(18:20);
  turn = skew(alpha) + skew(w)^2;
  rho = Q * machine.rho;
  f = machine.m * (a + turn * rho - machine.g);
  I = Q * machine.I * Q.';
  W = [I * alpha + skew(w) * I * w + skew(rho) * f; f];
  J = zeros(6);
  for i = 1:6
    arm = Q * machine.b(:, i);
    [row, F] = leg(machine, machine.u(:, i), p + arm - machine.a(:, i), v + skew(w) * arm, a + turn * arm);
    J(i, :) = [(skew(arm) * row.').', row];
    W += [skew(arm) * F; F];
  end
  tau = J.' \ W;
end

wrong = 0;
if numel(argv()) > 0, wrong = str2double(argv(){end}); end
machine = read_machine(getenv('URSULA_SCENARIO'));
while ischar(line = fgetl(stdin))
  tau = (1 + wrong) * torques(machine, sscanf(strrep(line, ',', ' '), '%f'));
  printf('%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n', tau);
  fflush(stdout);
end
