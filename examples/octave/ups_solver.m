% A hexapod on telescopic (U-P-S) legs in Octave: ursula validate my.toml --solver 'octave-cli --quiet ups_solver.m [ERROR]'
%
% Newton and Euler, each leg cut free at its two joints, for six legs that are alike and have no friction, without a
% load: a scenario such as `ursula init my.toml --kind UPS` writes. ERROR is put into the forces, relative.
% examples/python/ups_solver.py has friction, and legs that differ.
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
                             'c', numbers(links{k}, 'center_of_mass'), 'I', numbers(links{k}, 'inertia'));
  end
  machine.a = numbers(text, 'base_point').';
  machine.u = numbers(text, 'base_axis').';
  machine.u = machine.u ./ sqrt(sum(machine.u .^ 2));
  machine.b = numbers(text, 'platform_point').';
end

function c = cross3(a, b)
  c = a([2 3 1], :) .* b([3 1 2], :) - a([3 1 2], :) .* b([2 3 1], :);
end

function X = skew(v)
  X = [0 -v(3) v(2); v(3) 0 -v(1); -v(2) v(1) 0];
end

function Q = rotation(q)
  X = skew(q(2:4));
  Q = eye(3) + 2 * q(1) * X + 2 * X * X;
end

% I ω̇ + ω × I ω of six links with axes x, y, z.
function n = inertia_moment(I, x, y, z, w, w_dot)
  times = @(v) x .* (I(1) * sum(x .* v)) + y .* (I(2) * sum(y .* v)) + z .* (I(3) * sum(z .* v));
  n = times(w_dot) + cross3(w, times(w));
end

% Columns are legs. A leg turns about u, fixed in the base, and about x, square to u and to the leg.
function tau = forces(machine, in)
  p = in(2:4);  Q = rotation(in(5:8));  v = in(9:11);  w = in(12:14);  a = in(15:17);  alpha = in(18:20);
  turn = skew(alpha) + skew(w)^2;
  u = machine.u;  g = machine.g;
  arm = Q * machine.b;
  v_B = v + skew(w) * arm;
  a_B = a + turn * arm;
  e = p + arm - machine.a;  d = sqrt(sum(e .^ 2));  e = e ./ d;
  x = cross3(u, e);  sine = sqrt(sum(x .^ 2));  x = x ./ sine;  y = cross3(x, e);

  % v_B = ḋ e + d ω × e with ω = α u + β x.
  d_dot = sum(v_B .* e);
  about_u = sum(v_B .* x) ./ (d .* sine);  about_x = sum(v_B .* y) ./ d;
  w_leg = about_u .* u + about_x .* x;
  e_dot = cross3(w_leg, e);

  % a_B = d̈ e + 2 ḋ ė + d (ω̇ × e + ω × ė), and x turns with α u.
  d_ddot = sum(a_B .* e) + d .* sum(e_dot .^ 2);
  x_dot = about_u .* cross3(u, x);
  rest = (a_B - d_ddot .* e - 2 * d_dot .* e_dot) ./ d - cross3(w_leg, e_dot) - about_x .* cross3(x_dot, e);
  w_dot = sum(rest .* x) ./ sine .* u + sum(rest .* y) .* x + about_x .* x_dot;
  e_ddot = cross3(w_dot, e) + cross3(w_leg, e_dot);

  % What cylinder and rod resist with. The universal joint bears no moment about u and x: that gives the force at B
  % across the leg. The rod's balance gives the one along it, on top of which the motor's comes.
  k1 = machine.link(1);  k2 = machine.link(2);
  at_rod = d - k2.l + k2.c;
  f1 = k1.m * (k1.c * e_ddot - g);
  f2 = k2.m * (d_ddot .* e + 2 * d_dot .* e_dot + at_rod .* e_ddot - g);
  moment = cross3(k1.c * e, f1) + cross3(at_rod .* e, f2) + ...
           inertia_moment(k1.I + k2.I, x, cross3(e, x), e, w_leg, w_dot);
  F = -sum(u .* moment) ./ (d .* sine) .* x - sum(x .* moment) ./ d .* y - sum(e .* f2) .* e;

  % The platform's own, about P, less the legs' known forces; the motors bear the rest along the legs.
  rho = Q * machine.rho;
  f = machine.m * (a + turn * rho - g);
  I = Q * machine.I * Q.';
  tau = [cross3(arm, e); e] \ ([I * alpha + skew(w) * I * w + skew(rho) * f; f] - sum([cross3(arm, F); F], 2));
end

% Another script may source this one for its functions: ups_in_angles.m does.
if ~exist('functions_alone', 'var')
  wrong = 0;
  if numel(argv()) > 0, wrong = str2double(argv(){end}); end
  machine = read_machine(getenv('URSULA_SCENARIO'));
  % Not fgetl: that waits for the line after before it gives one.
  while numel(motion = fscanf(stdin, '%f,', 20)) == 20
    tau = (1 + wrong) * forces(machine, motion);
    printf('%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n', tau);
    fflush(stdout);
  end
end
